// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <array>
#include <cstddef>
#include <tuple>
#include <type_traits>
#include <utility>

/// A class whose values go to bytes names its fields once, in the order in which they are written:
///
///     static auto fields(auto& self) { return std::tie(self.first, self.second); }
///
/// Writer and reader both go by this list, and an aggregate that names fewer fields than it has
/// does not compile.
namespace tessera {

/// @brief Way to a list of fields that is private: the class makes this its friend.
struct FieldAccess {
  template <class T>
  static auto of(T& value) -> decltype(T::fields(value))
  {
    return T::fields(value);
  }
};

template <class T>
concept HasFields = std::is_class_v<T> && requires(T& value)
{
  FieldAccess::of(value);
};

/// @brief `std::tuple<Fields&...>` of a class with fields.
template <HasFields T>
using FieldsOf = decltype(FieldAccess::of(std::declval<T&>()));

/// @brief A class with an invariant: `void require_sound() const` throws InputError if the fields
/// that were read break it.
template <class T>
concept HasInvariant = requires(const T& value)
{
  value.require_sound();
};

namespace detail {

/// Stands for any field in a question about how many an aggregate takes.
struct AnyField {
  template <class T>
  operator T() const;  // NOLINT(google-explicit-constructor)
};

template <class T, std::size_t... I>
constexpr bool takes_fields(std::index_sequence<I...> /*numbers*/)
{
  return requires { T{(static_cast<void>(I), AnyField{})...}; };
}

/// Whether every member of an aggregate is in its list.
template <HasFields T>
constexpr bool names_all_fields()
{
  constexpr std::size_t kNumNamed = std::tuple_size_v<FieldsOf<T>>;
  return !std::is_aggregate_v<T> || !takes_fields<T>(std::make_index_sequence<kNumNamed + 1>{});
}

/// Whether a value has no padding, by its fields.
template <class T>
struct IsPlain {
  static constexpr bool value()
  {
    if constexpr (HasFields<T>) {
      static_assert(names_all_fields<T>(), "a member is missing in the list of fields");
      constexpr bool kTakesAnyBytes = std::is_trivially_copyable_v<T> && !HasInvariant<T>;
      return kTakesAnyBytes && of_fields(static_cast<FieldsOf<T>*>(nullptr));
    } else {
      return (std::is_arithmetic_v<T> && !std::is_same_v<T, bool>) || std::is_same_v<T, std::byte>;
    }
  }

 private:
  template <class... Fields>
  static constexpr bool of_fields(std::tuple<Fields&...>* /*type*/)
  {
    return (IsPlain<Fields>::value() && ...)
           && (std::size_t{0} + ... + sizeof(Fields)) == sizeof(T);
  }
};

/// As its elements.
template <class T, std::size_t N>
struct IsPlain<std::array<T, N>> {
  static constexpr bool value() { return IsPlain<T>::value(); }
};

}  // namespace detail

/// @brief Whether arrays of such values are copied in one piece. They are if a value in memory is
/// its fields without padding, and any bytes are a sound value.
template <class T>
inline constexpr bool kIsPlain = detail::IsPlain<T>::value();

}  // namespace tessera

// SPDX-License-Identifier: BSD-3-Clause
#pragma once

#include <algorithm>
#include <cstddef>
#include <initializer_list>
#include <iterator>
#include <memory>
#include <new>
#include <span>
#include <type_traits>
#include <utility>
#include <vector>

namespace tessera {

namespace detail {

/// Values that stand somewhere already, and what keeps them there.
template <class T>
struct BorrowedValues {
  T* data = nullptr;
  std::shared_ptr<const void> keeper{};
  bool is_offered = true;  ///< To the array that is just being made of them.
};

/// Memory from the heap, but for the first request of an array that borrows its values.
template <class T>
class BorrowingAllocator {
 public:
  using value_type = T;
  using propagate_on_container_move_assignment = std::true_type;
  using propagate_on_container_swap = std::true_type;

  BorrowingAllocator() = default;
  explicit BorrowingAllocator(std::shared_ptr<BorrowedValues<T>> borrowed)
      : borrowed_(std::move(borrowed))
  {
  }

  // Not inlined: GCC 12 else sees reads past the end that cannot happen.
  [[nodiscard, gnu::noinline]] T* allocate(std::size_t size)
  {
    return is_offered() ? borrowed_->data : std::allocator<T>().allocate(size);
  }

  void deallocate(T* data, std::size_t size)
  {
    if (borrowed_ && data == borrowed_->data)
      borrowed_.reset();
    else
      std::allocator<T>().deallocate(data, size);
  }

  /// Values that are borrowed stay as they are.
  template <class U>
  void construct(U* place)
  {
    if (!is_offered()) ::new (static_cast<void*>(place)) U();
  }

  /// A copy of an array has memory of its own.
  [[nodiscard]] BorrowingAllocator select_on_container_copy_construction() const { return {}; }

  friend bool operator==(const BorrowingAllocator& a, const BorrowingAllocator& b)
  {
    return a.borrowed_ == b.borrowed_;
  }

 private:
  [[nodiscard]] bool is_offered() const { return borrowed_ && borrowed_->is_offered; }

  std::shared_ptr<BorrowedValues<T>> borrowed_{};
};

}  // namespace detail

/// @brief A std::vector of plain values that may also *borrow* them: from a vector that is no
/// longer needed, or from memory that several processes share.
///
/// Who borrows holds the keeper of that memory. A copy owns its values. Values that are borrowed
/// from read-only memory must not be changed in place; the array can be assigned to.
template <class T>
class FlatArray : public std::vector<T, detail::BorrowingAllocator<T>> {
  static_assert(std::is_trivially_copyable_v<T>, "values are borrowed as bytes");
  using Allocator = detail::BorrowingAllocator<T>;
  using Base = std::vector<T, Allocator>;

 public:
  FlatArray() = default;
  explicit FlatArray(std::size_t size) : Base(size) {}
  FlatArray(std::size_t size, T value) : Base(size, value) {}
  FlatArray(std::initializer_list<T> values) : Base(values) {}
  template <std::input_iterator It>
  FlatArray(It first, It last) : Base(first, last)
  {
  }

  /// @brief A copy of the vector.
  FlatArray(const std::vector<T>& values)  // NOLINT(google-explicit-constructor)
      : Base(values.begin(), values.end())
  {
  }

  /// @brief The vector's own memory.
  FlatArray(std::vector<T>&& values)  // NOLINT(google-explicit-constructor)
  {
    const auto keeper = std::make_shared<std::vector<T>>(std::move(values));
    *this = borrowed(*keeper, keeper);
  }

  FlatArray(const FlatArray&) = default;
  FlatArray(FlatArray&&) noexcept = default;
  ~FlatArray() = default;

  /// Never in place: what is there may be borrowed.
  FlatArray& operator=(FlatArray other) noexcept
  {
    this->swap(other);
    return *this;
  }

  /// @brief An array of these very values. @param[in] keeper Of their memory.
  [[nodiscard]] static FlatArray borrowed(std::span<const T> values,
                                          std::shared_ptr<const void> keeper)
  {
    if (values.empty()) return {};
    const auto source = std::make_shared<detail::BorrowedValues<T>>();
    source->data = const_cast<T*>(values.data());
    source->keeper = std::move(keeper);
    FlatArray array(Base(values.size(), Allocator(source)));
    source->is_offered = false;
    return array;
  }

  /// @brief A copy, for those who want a vector.
  [[nodiscard]] std::vector<T> to_vector() const { return {this->begin(), this->end()}; }

  friend bool operator==(const FlatArray& a, const std::vector<T>& b)
  {
    return std::equal(a.begin(), a.end(), b.begin(), b.end());
  }

 private:
  explicit FlatArray(Base&& values) : Base(std::move(values)) {}
};

}  // namespace tessera

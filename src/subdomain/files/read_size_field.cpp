// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/subdomain/read_size_field.hpp"

#include "tessera/base/bytes.hpp"
#include "tessera/base/error.hpp"
#include "tessera/io/point_field.hpp"

namespace tessera::subdomain {
namespace {

mesh::PointField read_field(const sizing::SizeOptions& options)
{
  try {
    return io::read_point_field(options.field, options.field_array);
  } catch (const InputError& error) {
    throw InputError(std::string("size.field: ") + error.what());
  }
}

}  // namespace

sizing::SizeField read_size_field(const sizing::SizeOptions& options,
                                  const mesh::CoarseMesh& coarse)
{
  if (options.field.empty()) return {options, coarse};
  const mesh::PointField field = read_field(options);
  return {options, coarse, &field};
}

Hash128 size_field_content(const sizing::SizeOptions& options)
{
  return options.field.empty() ? Hash128{} : hash_bytes(to_bytes(read_field(options)));
}

}  // namespace tessera::subdomain

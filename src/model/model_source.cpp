// SPDX-License-Identifier: BSD-3-Clause
#include "tessera/model/model.hpp"

namespace tessera::model {

Bytes to_bytes(const ModelSource& source)
{
  ByteWriter out;
  out.put(source.format);
  out.put(source.file_name);
  out.put(source.length_unit);
  out.put(source.content);
  out.put(source.repairs);
  return std::move(out).take();
}

ModelSource model_source_from_bytes(std::span<const std::byte> bytes)
{
  ByteReader in(bytes);
  ModelSource source;
  source.format = in.get<Format>();
  source.file_name = in.get_string();
  source.length_unit = in.get_string();
  source.content = in.get_vector<std::byte>();
  source.repairs = in.get_strings();
  return source;
}

}  // namespace tessera::model

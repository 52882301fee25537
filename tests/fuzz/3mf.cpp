#include "mesh_file.h"
#include "zipped.h"

// What begins as an archive is one; other inputs are the model in it, as hardly any change leaves an archive whole.
extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
  std::string bytes = raytube::fuzz::text_of(data, size);
  if (!bytes.starts_with("PK")) bytes = raytube::testing::packed_3mf(bytes);
  return raytube::fuzz::read_mesh(raytube::parse_3mf, reinterpret_cast<const std::uint8_t*>(bytes.data()), bytes.size());
}

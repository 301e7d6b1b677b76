// A mesh in glTF, as JSON or binary, gives a body or an error.
#include "file_input.h"

extern "C" int DRAPE_FUZZ_ENTRY(mesh_gltf)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    fuzz::read_mesh_file("mesh.gltf", data, size);
    return 0;
}

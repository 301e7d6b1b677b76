// A mesh in STL gives a body or an error.
#include "file_input.h"

extern "C" int DRAPE_FUZZ_ENTRY(mesh_stl)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    fuzz::read_mesh_file("mesh.stl", data, size);
    return 0;
}

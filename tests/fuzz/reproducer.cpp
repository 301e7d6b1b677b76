// A failed run's reproducer, raw and with its checksum repaired, gives an error, or settings that hold and a scene that
// can be loaded or says why not.
#include "run/reproducer.h"

#include "base/output_error.h"
#include "section_input.h"

namespace drape {
namespace {

using fuzz::require;

void read_reproducer(std::span<const std::byte> file) {
    Reproducer reproducer;
    try {
        reproducer = decode_reproducer(file);
    } catch (const OutputError& error) {
        require(!std::string(error.what()).empty(), "refused without a reason");
        return;
    }
    require(reproducer.step > 0, "a step of no frames");
    require(Kernels::parse(reproducer.scene.kernels.text()) == reproducer.scene.kernels,
            "kernels that their names do not give");
    try {
        static_cast<void>(load_text(reproducer.scene, reproducer.scene_text));
    } catch (const SceneFailure& failure) {
        require(!failure.result().errors.empty(), "a scene refused without an error");
    }
}

}  // namespace
}  // namespace drape

extern "C" int DRAPE_FUZZ_ENTRY(reproducer)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    std::vector<std::byte> file = fuzz::bytes_of(data, size);
    read_reproducer(file);
    fuzz::repair(reproducer_format, file);
    read_reproducer(file);
    return 0;
}

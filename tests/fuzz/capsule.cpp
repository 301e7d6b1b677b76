// A failed run's capsule, raw and with its checksum repaired, gives an error, or settings that hold and a scene that
// can be loaded or says why not.
#include "output/output_error.h"
#include "run/failure_capsule.h"
#include "section_input.h"

namespace drape {
namespace {

using fuzz::require;

void read(std::span<const std::byte> file) {
    FailureCapsule capsule;
    try {
        capsule = decode_capsule(file);
    } catch (const OutputError& error) {
        require(!std::string(error.what()).empty(), "refused without a reason");
        return;
    }
    require(capsule.step > 0, "a step of no frames");
    require(Kernels::parse(capsule.scene.kernels.text()) == capsule.scene.kernels,
            "kernels that their names do not give");
    try {
        static_cast<void>(load_text(capsule.scene, capsule.scene_text));
    } catch (const SceneFailure& failure) {
        require(!failure.result().errors.empty(), "a scene refused without an error");
    }
}

}  // namespace
}  // namespace drape

extern "C" int LLVMFuzzerTestOneInput(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    std::vector<std::byte> file = fuzz::bytes_of(data, size);
    read(file);
    fuzz::repair(capsule_format, file);
    read(file);
    return 0;
}

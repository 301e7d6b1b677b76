// A drawing gives finite closed curves or an error; its shapes alone and all of them.
#include "input/svg_file.h"

#include <stdexcept>

#include "file_input.h"

extern "C" int DRAPE_FUZZ_ENTRY(svg_file)(const std::uint8_t* data, std::size_t size) {
    using namespace drape;
    fuzz::read_file("drawing.svg", data, size, [](const std::filesystem::path& path) {
        for (const char* element : {"", "f", "c"}) try {
                for (const input::PathCurve& curve : input::read_svg(path, {element, {}, 1e-4})) {
                    fuzz::require(curve.points.size() > 2, "a curve goes around something");
                    for (const auto& at : curve.points)
                        fuzz::require(std::isfinite(at[0]) && std::isfinite(at[1]), "a point is finite");
                }
            } catch (const std::invalid_argument& error) {
                fuzz::require(std::string(error.what()).size() > 10, "an error that says nothing");
            }
    });
    return 0;
}

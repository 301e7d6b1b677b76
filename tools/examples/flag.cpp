// Builds a flag in the wind in code and steps through it; its last frame becomes flag.ppm.
#include <drape/simulation.h>

#include <cstdio>
#include <fstream>

int main(int argc, char** argv) try {
    drape::Cloth cloth;
    cloth.name = "flag";
    cloth.grid = {48, 32};  // particles: columns, rows
    cloth.size = {1.5, 1};  // m
    cloth.placement.origin = {-0.75, 1.5, 0};
    drape::Pin pole;
    pole.particles = {{0, 0}, {0, 31}};  // the first column
    cloth.pins.push_back(pole);

    drape::SceneDescription scene;
    scene.time.frame_count = 61;
    scene.wind.velocity = {6, 0, 2};  // m/s
    scene.cloths.push_back(cloth);
    scene.image.size = {480, 320};

    drape::SimulationOptions options;
    options.draw = true;
    drape::Simulation simulation(scene, options, drape::Device(argc > 1 ? argv[1] : ""));
    while (simulation.step()) {
        const drape::FinishedFrame& frame = simulation.frame();
        if (frame.frame % 10 != 0) continue;
        const float* corner = &frame.positions[0][4 * 47];  // x y z w of column 47, row 0
        std::printf("frame %u: %.3f %.3f %.3f, stretched by %.2f %%\n", frame.frame, corner[0], corner[1], corner[2],
                    100 * frame.statistics[0].stretch.rms);
    }
    std::ofstream picture("flag.ppm", std::ios::binary);
    picture << "P6 480 320 255\n";
    for (std::size_t i = 0; i < simulation.frame().rgba.size(); ++i)
        if (i % 4 != 3) picture.put(static_cast<char>(simulation.frame().rgba[i]));
} catch (const drape::Error& error) {
    std::fprintf(stderr, "%s\n", error.what());
    return 1;
}

// Meshes with the faults that files of real bodies have are taken as solids, say what was mended, and keep cloth that
// falls on them out: by the winding number of the shape without faults, no particle is inside in any frame.
#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <cstdio>
#include <functional>
#include <numbers>
#include <random>
#include <set>
#include <string>
#include <vector>

#include "base/vectors.h"
#include "support/meshes.h"
#include "support/sheets.h"
#include "twin/twin.h"

namespace drape {
namespace {

using test::Triangles;
using test::winding;

void turn_over(Triangle& triangle) { std::swap(triangle[0], triangle[1]); }

/// Without the triangles below a height.
Triangles open_below(Triangles mesh, double height) {
    std::erase_if(mesh.triangles, [&](const Triangle& t) {
        return std::ranges::all_of(t, [&](std::uint32_t k) { return mesh.vertices[k][1] < height; });
    });
    return mesh;
}
/// Without every triangle at some vertices.
Triangles with_holes(Triangles mesh, std::mt19937& random) {
    for (int hole = 0; hole < 3; ++hole) {
        const auto vertex = static_cast<std::uint32_t>(random() % mesh.vertices.size());
        std::erase_if(mesh.triangles, [&](const Triangle& t) { return std::ranges::find(t, vertex) != t.end(); });
    }
    return mesh;
}
Triangles doubled(Triangles mesh) {
    const std::vector<Triangle> single = mesh.triangles;
    for (Triangle back : single) {
        turn_over(back);
        mesh.triangles.push_back(back);
    }
    return mesh;
}
Triangles with_mixed_normals(Triangles mesh, std::mt19937& random) {
    for (Triangle& triangle : mesh.triangles)
        if (random() % 3 == 0) turn_over(triangle);
    return mesh;
}
/// With smaller bodies beside it and in it, one of which is inside out.
Triangles with_loose_parts(Triangles mesh) {
    Triangles bolt = test::ball_mesh(0.03, 12), nut = test::box_mesh({0.02, 0.02, 0.02});
    for (Triangle& triangle : nut.triangles) turn_over(triangle);
    test::shift(bolt, {0.1, -0.35, 0.05});
    test::shift(nut, {-0.1, -0.4, 0});
    test::add(mesh, bolt);
    test::add(mesh, nut);
    return mesh;
}
/// Each triangle with corners of its own, which gape by 1e-7 m.
Triangles gaping(const Triangles& mesh, std::mt19937& random) {
    std::uniform_real_distribution<double> off(-5e-8, 5e-8);
    Triangles soup;
    for (const Triangle& triangle : mesh.triangles) {
        const auto first = static_cast<std::uint32_t>(soup.vertices.size());
        for (const std::uint32_t corner : triangle) {
            const Vec3& at = mesh.vertices[corner];
            soup.vertices.push_back({at[0] + off(random), at[1] + off(random), at[2] + off(random)});
        }
        soup.triangles.push_back({first, first + 1, first + 2});
    }
    return soup;
}

struct Body {
    std::string name;
    Triangles whole, faulty;
    Solid solid = Solid::mended;
    Vec3 position{};
    bool needs_mending = true;
};

/// Seven kinds of fault of three shapes, four of them at once, and five of them in two ways.
std::vector<Body> bodies() {
    std::mt19937 random(22);
    std::vector<Body> all;
    const std::pair<const char*, Triangles> shapes[] = {{"ball", test::ball_mesh(0.2, 32)},
                                                        {"ring", test::torus_mesh(0.2, 0.08, 32)},
                                                        {"rod", test::capsule_mesh(0.1, 0.12, 24)}};
    for (const auto& [shape, sound] : shapes) {
        const auto add = [&, shape = shape, &sound = sound](const char* kind, Triangles faulty) -> Body& {
            return all.emplace_back(Body{std::string(shape) + " " + kind, sound, std::move(faulty)});
        };
        double low = 0;
        for (const Vec3& vertex : sound.vertices) low = std::min(low, vertex[1]);
        add("open below", open_below(sound, 0.7 * low)).solid = Solid::filled;
        add("with holes", with_holes(sound, random));
        add("doubled", doubled(sound));
        add("with mixed normals", with_mixed_normals(sound, random));
        add("with loose parts", with_loose_parts(sound));
        add("gaping", gaping(sound, random));
        Triangles far = sound;
        const Vec3 away{12000, -3000, 7000};
        test::shift(far, away);
        Body& body = add("far away", std::move(far));
        body.position = times(-1, away);
        body.needs_mending = false;
    }
    const Triangles& ball = shapes[0].second;
    const Triangles most = with_mixed_normals(with_holes(with_loose_parts(ball), random), random);
    all.push_back({"ball with most of it", ball, gaping(most, random)});
    all.push_back({"ball with most of it, doubled", ball, doubled(gaping(most, random))});
    all.push_back({"ball doubled, with the rest", ball,
                   gaping(with_mixed_normals(doubled(with_holes(with_loose_parts(ball), random)), random), random)});
    return all;
}

TEST(MendedBodies, TwentyFourKeepClothOut) {
    const std::vector<Body> all = bodies();
    ASSERT_EQ(all.size(), 24u);
    for (const Body& body : all) {
        SCOPED_TRACE(body.name);
        Mesh mesh;
        mesh.position = body.position;
        mesh.shape = std::make_shared<const MeshShape>(body.faulty.vertices, body.faulty.triangles, std::nullopt,
                                                       nullptr, body.solid);
        EXPECT_EQ(mesh.shape->mending().text().empty(), !body.needs_mending) << mesh.shape->mending().text();
        SceneDescription scene = test::sheet(21, 21, 0.6, 0.6, 8);
        scene.cloths[0].placement = {{-0.3, 0.25, -0.3}, {1, 0, 0}, {0, 0, 1}};
        scene.cloths[0].pins.clear();
        scene.cloths[0].thickness = 0.01;
        scene.colliders = {{mesh, 0.3}};
        scene.solver.method = SolverMethod::line;
        const SimulationModel model(scene);
        Twin twin(model);
        std::size_t inside = 0, touched = 0;
        for (std::uint32_t frame = 1; frame <= 20; ++frame) {
            twin.run_frame(frame);
            if (frame % 5 != 0) continue;
            for (const glsl::vec4& p : twin.cloth(0)[Field::position]) {
                const Vec3 at{double{p.x}, double{p.y}, double{p.z}};
                inside += length(at) < 0.4 && winding(body.whole, at) > 0.5 ? 1 : 0;
                touched += mesh.shape->distance(minus(minus(at, body.position), mesh.shape->middle())) < 0.011 ? 1 : 0;
            }
        }
        std::printf("[ measured ] %s: %s; %zu particles touch it, %zu are inside\n", body.name.c_str(),
                    mesh.shape->mending().text().c_str(), touched, inside);
        EXPECT_EQ(inside, 0u);
        EXPECT_GT(touched, 0u);
    }
}

}  // namespace
}  // namespace drape

#include "run/contact_proof.h"

#include <fmt/format.h>

#include <algorithm>

#include "world/contact_shape.h"
#include "world/seam_cover.h"

namespace drape {

namespace {

/// Returns the frame from which on cloths that started through each other have been apart.
std::optional<std::uint32_t> apart_since(const SelfContactReport& told, const Simulation& simulation) {
    if (!told.last_crossed || *told.last_crossed + 1 >= simulation.next_frame()) return std::nullopt;
    return *told.last_crossed + 1;
}

/// Tells which triangles meet nothing for the sake of their seams.
void leave_out_at_seams(const SceneDescription& scene, Manifest::SelfCollision& proof) {
    const SeamCover seams(scene);
    for (std::size_t k = 0; k < seams.cloths.size(); ++k) {
        const SeamCover::OfCloth& own = seams.cloths[k];
        if (own.never_count + own.closing_count == 0) continue;
        proof.beside_seams.push_back({scene.cloths[k].name, own.never_count, own.closing_count});
        proof.seams_close = std::max(proof.seams_close, std::ranges::max(own.until));
    }
}

Manifest::SelfCollision self_collision_of(const Simulation& simulation, const SelfContactReport& told) {
    const std::vector<Cloth>& cloths = simulation.scene().cloths;
    Manifest::SelfCollision proof{.cloths = {},
                                  .between_cloths = cloths.size() > 1,
                                  .first_unproved = told.first_unproved,
                                  .not_covered = {},
                                  .beside_seams = {},
                                  .seams_close = 0,
                                  .most_pairs = told.most_pairs,
                                  .truncated = told.truncated,
                                  .longest_lag = told.longest_lag,
                                  .lag_limit = told.lag_limit,
                                  .lagging_frames = told.lagging_frames,
                                  .crossed = {},
                                  .apart_since = apart_since(told, simulation)};
    for (const Cloth& cloth : cloths)
        if (cloth.self_collision) proof.cloths.push_back(cloth.name);
    leave_out_at_seams(simulation.scene(), proof);
    for (const auto& [one, other] : told.crossed) proof.crossed.emplace_back(cloths[one].name, cloths[other].name);
    return proof;
}

bool meets_edges(const SceneDescription& scene, const std::string& name) {
    const auto cloth = std::ranges::find(scene.cloths, name, &Cloth::name);
    return cloth != scene.cloths.end() && meets_edges(*cloth, scene.colliders);
}

}  // namespace

std::vector<Manifest::SplitTriangles> split_triangles(std::span<const Manifest::Cut> cuts, std::int64_t last) {
    std::vector<Manifest::SplitTriangles> all;
    for (const Manifest::Cut& cut : cuts) {
        if (cut.triangle_count == 0 || cut.frame >= last) continue;
        auto found = std::ranges::find(all, cut.cloth, &Manifest::SplitTriangles::cloth);
        if (found == all.end()) found = all.insert(all.end(), {cut.cloth, cut.frame + 1, 0});
        found->count += cut.triangle_count;
    }
    return all;
}

void describe_contact(Manifest& manifest, const Simulation& simulation, std::span<const Manifest::Cut> cuts) {
    const std::vector<Manifest::SplitTriangles> split = split_triangles(cuts, manifest.frames.end);
    if (const std::optional<SelfContactReport> told = simulation.self_contact()) {
        manifest.self_collision = self_collision_of(simulation, *told);
        manifest.self_collision->not_covered = split;
    }
    for (const Manifest::SplitTriangles& each : split)
        if (meets_edges(simulation.scene(), each.cloth)) manifest.off_collider_edges.push_back(each);
}

std::optional<std::string> left_out_triangles(const Manifest& manifest) {
    const bool of_cloths = manifest.self_collision && !manifest.self_collision->not_covered.empty();
    const bool of_edges = !manifest.off_collider_edges.empty();
    if (!of_cloths && !of_edges) return std::nullopt;
    const auto& split = of_cloths ? manifest.self_collision->not_covered : manifest.off_collider_edges;
    const std::string_view contact = of_cloths && of_edges ? "no cloth and no edge of a collider"
                                     : of_cloths           ? "no cloth"
                                                           : "no edge of a collider";
    return fmt::format("{} that were split from frame {} on meet {}; a finer grid makes the strip of them narrower",
                       triangles_text(split), split.front().first_frame, contact);
}

std::optional<std::string> lost_proof(const Simulation& simulation) {
    const std::optional<SelfContactReport> told = simulation.self_contact();
    if (!told || !told->first_unproved || *told->first_unproved == 0) return std::nullopt;
    return fmt::format(
        "from frame {} on it is not proved that no cloth passes through {}: a held particle moved farther than was "
        "shown to cross nothing, or cloth touched; slower pins or more substeps may help",
        *told->first_unproved, simulation.scene().cloths.size() > 1 ? "itself or another" : "itself");
}

std::optional<std::string> held_back(const Simulation& simulation) {
    const std::optional<SelfContactReport> told = simulation.self_contact();
    if (!told || !told->first_lagging) return std::nullopt;
    return fmt::format(
        "in {} frame{}, from frame {} on, cloth was held back from where it would have passed through other cloth by "
        "more than {:.3g} m, half of the particle distance, in a substep ({:.3g} m at most): it lags behind its "
        "motion; {}",
        told->lagging_frames, told->lagging_frames == 1 ? "" : "s", *told->first_lagging, told->lag_limit,
        told->longest_lag,
        simulation.facts().limits_are_kept ? "method auto counts that as error of the motion"
                                           : "more substeps may help");
}

std::optional<std::string> still_crossed(const Simulation& simulation) {
    const std::optional<SelfContactReport> told = simulation.self_contact();
    if (!told || !told->last_crossed || apart_since(*told, simulation)) return std::nullopt;
    return "cloths that started through each other still are in the last frame";
}

}  // namespace drape

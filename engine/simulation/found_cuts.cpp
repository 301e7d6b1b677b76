#include "simulation/found_cuts.h"

#include <cstring>

#include "cloth/tear.h"
#include "solver/cut_pass.h"
#include "solver/state_transfer.h"
#include "solver/tear_pass.h"
#include "world/weather.h"

namespace drape {

namespace {

/// What a search found of one cloth.
struct Hit {
    std::size_t cloth;
    CutFindings cut;
    std::vector<glsl::vec4> loads;
    CutImages before;
};

/// Fetches what the search found, before any resource changes.
std::vector<Hit> found_hits(FrameGraphs& graphs, std::uint32_t slot, std::uint32_t frame) {
    const SimulationModel& model = graphs.joint();
    const graph::ResourcePool& pool = graphs.pool();
    const auto found = [&](const std::string& count_name) {
        std::uint32_t count = 0;
        if (pool.has(count_name)) std::memcpy(&count, pool.buffer(count_name, slot).mapped().data(), sizeof count);
        return count > 0;
    };
    std::vector<Hit> hits;
    for (std::size_t cloth = 0; cloth < model.cloths.size(); ++cloth) {
        const ClothModel& own = model.cloths[cloth];
        const bool crossed = found(cut_count_name(own)), overloaded = frame > 0 && found(tear_count_name(own));
        if (!crossed && !overloaded) continue;
        graphs.layout().topologies[cloth].set_stiffness(
            static_cast<float>(stiffness_factor(model.scene, model.scene.cloths[cloth], frame)));
        Hit& hit = hits.emplace_back(Hit{cloth, {}, {}, cut_images(graphs.layout(), cloth)});
        if (crossed) hit.cut = read_findings(pool, own);
        if (overloaded) hit.loads = read_tear_loads(pool, own);
    }
    return hits;
}

CutCounts applied(CutTopology& topology, const Hit& hit) {
    CutCounts counts;
    if (!hit.cut.fractions.empty()) counts = topology.apply(hit.cut);
    if (hit.loads.empty()) return counts;
    const CutCounts torn = topology.apply(torn_springs(topology, hit.loads));
    return {counts.springs + torn.springs, counts.triangles + torn.triangles, torn.springs,
            torn.any() ? torn.pieces : counts.pieces, torn.any() ? torn.crumbs : counts.crumbs};
}

}  // namespace

bool take_cuts(FrameGraphs& graphs, std::uint32_t slot, std::uint32_t frame, const CutListener& listener) {
    bool new_resources = false, tore = false;
    const std::vector<Hit> hits = found_hits(graphs, slot, frame);
    for (const Hit& hit : hits) {
        CutTopology& topology = graphs.layout().topologies[hit.cloth];
        new_resources = new_resources || !topology.masked();
        const CutCounts counts = applied(topology, hit);
        tore = tore || counts.torn > 0;
        new_resources = new_resources || (graphs.options().draw && draws_outgrown(hit.before, topology));
        if (listener) listener({frame, hit.cloth, counts}, topology);
    }
    if (new_resources) {
        graphs.rebuild(download_state(graphs.layout(), graphs.pool()));
        return tore;
    }
    for (const Hit& hit : hits) upload_cut(graphs.layout(), graphs.pool(), hit.cloth, hit.before);
    if (!hits.empty()) graphs.draw_anew();
    return tore;
}

}  // namespace drape

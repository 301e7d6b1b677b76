// No solver method and no cut changes these numbers of a cloth: its grid, masses, wanted stiffness, the flat state that
// it starts in, its pins and tethers.
#pragma once

#include <array>
#include <optional>
#include <string>
#include <vector>

#include "cloth/grid.h"
#include "cloth/stiffness_constants.h"
#include "cloth/tethers.h"
#include "drape/compromise.h"
#include "drape/scene.h"
#include "shared/simulation_types.h"

namespace drape {

/// Something that a scene does not need and therefore does not get.
struct SkippedWork {
    std::string what, reason;
};

/// A pin that moves or lets go; pins at rest for ever are just w = 0.
struct DynamicPin {
    MotionPath path;
    Vec3 pivot;                     ///< m
    std::optional<double> release;  ///< s
    std::size_t number;             ///< among the cloth's pins
};

struct ClothGeometry {
    /// `keeps_masks` makes the masks of a whole cloth images too.
    ClothGeometry(const SceneDescription& scene, const Cloth& cloth, bool keeps_masks);

    std::string name;
    Grid grid;
    bool stiffens;          ///< keys change its stiffness: a step gives its spring shares their factor in every frame
    float start_stiffness;  ///< that factor in frame 0
    bool starts_masked;     ///< holes, maps, a rest shape or such keys: spring shares are images from the start
    Placement placement;
    bool is_given;                          ///< the start is a given shape, not the placed one
    double start_strain;                    ///< largest magnitude of the strain of a spring along a row or column
    std::array<double, 2> spacing;          ///< m along columns, rows
    double inner_mass;                      ///< kg of a particle with four cells
    double damping;                         ///< 1/s
    Vec3 velocity;                          ///< m/s at the start, of all particles
    std::vector<Vec3> velocities;           ///< m/s at the start by particle; empty: `velocity`
    double start_speed;                     ///< m/s: the largest
    bool rigid;                             ///< stretch and shear springs are inextensible
    float compression;                      ///< share of their stiffness where they are pushed together
    double bend;                            ///< N m
    StiffnessConstants stiffness_constant;  ///< wanted by the scene

    // These have one element per particle, row by row.
    std::vector<glsl::vec4> position;  ///< at the start; xyz m; w: relative inverse mass, 0 = pinned or without a cell
    std::vector<float> free_weight;    ///< w without pins
    /// x: thickness kept from colliders, m; y: square root of the friction coefficient. Empty: they are the cloth's.
    std::vector<glsl::vec2> skin;
    /// Lengths of the springs that a particle owns at rest over those of flat cloth, by direction; empty: 1.
    std::vector<glsl::vec4> rest_scales;
    std::vector<glsl::ParticleTethers> tethers;  ///< none unless the scene has them and the cloth pins
    /// Its springs along row and column bear this much before they tear (cloth/tear.h); empty: everything.
    std::vector<glsl::vec4> tear_limits;

    std::vector<DynamicPin> dynamic_pins;
    std::vector<glsl::PinnedParticle> pinned;  ///< particles of the dynamic pins
    bool has_release = false, has_motion = false;
    bool shows_crumbs;  ///< small pieces that are cut off are drawn
    std::vector<SkippedWork> skipped;

    /// Returns the unit direction of growing column (axis 0) or row at a particle as it starts.
    Vec3 start_direction(std::uint32_t particle, std::size_t axis) const;
    /// Returns the length at rest, m, of a spring that `particle` owns, as the device computes it from that on flat
    /// cloth.
    float rest_length(float flat, std::size_t particle, std::size_t direction) const;
    /// Returns whether bending, too, is at rest in the shape that the cloth starts in.
    bool rests_bent() const { return bend > 0 && !rest_scales.empty(); }
    /// Returns the energy, J, that bending stores in the shape that it starts in, as if all of its cells were there.
    double start_bending() const;
    /// Returns the diagonal of the cloth at rest, m, or more.
    float reach() const;

  private:
    void place(const Cloth& cloth);
    void hold_pins(const std::vector<Pin>& pins);
    void set_tethers(const SceneDescription& scene, const Cloth& cloth);
};

}  // namespace drape

// The numbers of a cloth that neither solver method nor cut changes: its grid, masses, wanted stiffness, the state in
// which it starts, its pins and tethers.
#pragma once

#include <array>
#include <cstdint>
#include <optional>
#include <string>
#include <vector>

#include "cloth/grid.h"
#include "cloth/sewing.h"
#include "cloth/stiffness_constants.h"
#include "cloth/tethers.h"
#include "drape/compromise.h"
#include "drape/scene.h"
#include "shared/simulation_types.h"

namespace drape {

/// Something that the scene does not need, so no work is done for it.
struct SkippedWork {
    std::string what, reason;
};

/// What actions may do to a cloth, beside moving its pins.
struct ClothActions {
    bool holds = false;                   ///< pins let go and take again
    std::vector<std::size_t> hands = {};  ///< the numbers of the hands that take its particles
};

inline constexpr IndexBox no_particles{{1, 1}, {0, 0}}, all_particles{{0, 0}, {INT32_MAX, INT32_MAX}};

/// A pin that moves or lets go, or a hand; pins at rest for ever are just w = 0. A hand may hold any of the cloth's
/// particles, and none at first; its pivot is the origin, so that its path says where it is.
struct DynamicPin {
    MotionPath path;
    Vec3 pivot;                            ///< m
    std::optional<double> release;         ///< s
    std::size_t number;                    ///< among the cloth's pins
    std::optional<std::size_t> hand = {};  ///< its number among all hands; nothing: it is a pin of the scene
    bool follows = false;                  ///< it took its particles where they were, and moves them from there
    MotionPath let_go = {};                ///< its path until an action released it; without keys: `path`
    IndexBox held = all_particles;  ///< of the particles in its list those that it holds, or held until its release
    /// Returns whether it holds them at a time, s.
    bool holds(double time) const { return !release || *release > time + 1e-9; }
};

struct ClothGeometry {
    /// `keeps_masks`: a whole cloth, too, gets its masks as images.
    ClothGeometry(const SceneDescription& scene, const Cloth& cloth, bool keeps_masks,
                  const ClothActions& actions = {});

    std::string name;
    Grid grid;
    bool stiffens;  ///< keys change its stiffness: in every frame a step multiplies its spring shares by their factor
    float start_stiffness;  ///< that factor in frame 0
    bool
        starts_masked;  ///< it has holes, maps, a rest shape or stiffness keys: spring shares are images from the start
    Placement placement;
    bool is_given;                          ///< the start is a given shape, not the placed one
    double start_strain;                    ///< the largest absolute strain of a spring along a row or column
    std::array<double, 2> spacing;          ///< m along columns, rows
    double inner_mass;                      ///< kg of a particle with four cells
    double damping;                         ///< 1/s
    Vec3 velocity;                          ///< m/s at the start, of all particles
    std::vector<Vec3> velocities;           ///< m/s at the start by particle; empty: `velocity`
    double start_speed;                     ///< m/s: the largest
    bool rigid;                             ///< stretch and shear springs are inextensible
    float compression;                      ///< share of their stiffness that springs have under compression
    double bend;                            ///< N m: the largest of its rigidities
    StiffnessConstants stiffness_constant;  ///< wanted by the scene

    // The following lists have one element per particle, row by row.
    std::vector<glsl::vec4> position;  ///< at the start; xyz m; w: relative inverse mass, 0 = pinned or without a cell
    std::vector<float> free_weight;    ///< the relative inverse masses without pins
    /// x: thickness kept from colliders, m; y: square root of the friction coefficient. Empty: every particle has the
    /// cloth's.
    std::vector<glsl::vec2> skin;
    /// For each particle, the rest lengths of the springs that it owns, divided by those of flat cloth, by direction;
    /// empty: 1.
    std::vector<glsl::vec4> rest_scales;
    std::vector<glsl::vec4> panel;  ///< m: where particles lie on the flat cloth of an outline; empty: it has none
    std::vector<glsl::ParticleTethers> tethers;  ///< empty unless the scene has tethers and the cloth has pins
    /// The load at which the springs along row and column tear (cloth/tear.h); empty: they never tear.
    std::vector<glsl::vec4> tear_limits;

    std::vector<Sewn> sewn;  ///< its particles at seams

    std::uint32_t load_depth = 0;   ///< the largest number of loads on a particle
    std::vector<glsl::vec4> loads;  ///< load_texels (cloth/loads.h)

    std::vector<DynamicPin> dynamic_pins;
    std::vector<glsl::PinnedParticle> pinned;  ///< particles of the dynamic pins; every hand lists all that there are
    bool has_release = false, has_motion = false;
    bool shows_crumbs;  ///< small pieces that are cut off are drawn
    std::vector<SkippedWork> skipped;

    /// Returns the unit direction of growing column (axis 0) or row at a particle as it starts.
    Vec3 start_direction(std::uint32_t particle, std::size_t axis) const;
    /// Returns the rest length, m, of a spring that `particle` owns, as the device computes it from the length on flat
    /// cloth.
    float rest_length(float flat, std::size_t particle, std::size_t direction) const;
    /// Returns whether bending, too, is at rest in the shape that the cloth starts in.
    bool rests_bent() const { return bend > 0 && !rest_scales.empty(); }
    /// Returns where particles are in the shape in which bending is at rest, m.
    const std::vector<glsl::vec4>& rest_shape() const { return panel.empty() ? position : panel; }
    /// Returns the energy, J, that bending stores in the shape in which the cloth starts, as if no cell were missing.
    double start_bending() const;
    /// Returns the length, m, of the cloth's diagonal at rest, or more.
    float reach() const;

  private:
    void place(const Cloth& cloth);
    void sew(std::vector<Sewn> particles);
    void hold_pins(const std::vector<Pin>& pins);
    void add_hands(const std::vector<std::size_t>& hands);
    void set_tethers(const SceneDescription& scene, const Cloth& cloth);
};

}  // namespace drape

// The steps of gas find here what they need to know of the cloths that close it in (world/gas.h). Pure.
#pragma once

#include <cstddef>
#include <cstdint>
#include <span>
#include <vector>

#include "drape/scene.h"
#include "drape/statistics.h"
#include "shared/gas_types.h"

namespace drape {

struct ClothModel;
struct SimulationModel;

/// Ties a cloth to the gas that it closes in.
struct ClothGas {
    std::size_t number;  ///< of the gas among the scene's
    double sign;         ///< 1: its front is outside; -1: its back
    int first, count;    ///< the sums of all cloths of the gas among those of all cloths
    int own;             ///< the first of these that is the cloth's
    float ambient;       ///< Pa
    /// Each particle has its part of the place where it is sewn, and what the square of that place's area counts, 1/kg;
    /// both are 0 of what lies between two places, which have its area.
    std::vector<glsl::vec2> shares;
    glsl::GasState start;  ///< at the start: its pressure and volume
};

/// Returns the number of sums of a cloth that closes gas in.
std::uint32_t gas_sum_count(const ClothModel& cloth);
/// Gives each cloth of a scene that closes gas in what it has to do with it, and its half kick (ClothModel::kick).
/// Returns the number of sums of all.
std::size_t add_gas(const SceneDescription& scene, std::vector<ClothModel>& cloths);

glsl::GasAreaPush gas_area_push(const ClothModel& cloth);
glsl::GasSumPush gas_sum_push(const ClothModel& cloth);
/// `joint`: sewn_joints of the cloth; `ends`: it is a frame's end.
glsl::GasPush gas_push(const SimulationModel& model, const ClothModel& cloth, std::uint32_t substep, int joint,
                       bool ends);

/// Returns the statistics of a gas from a cloth's Field::gas.
GasStatistics gas_statistics(std::span<const std::byte> state);

}  // namespace drape

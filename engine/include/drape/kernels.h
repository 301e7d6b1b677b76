// The kernels, shaders that do a step's work, that a simulation may use. Every step has a plain kernel; faster ones
// give the same bits, except those that solve lines otherwise than by walking along them, which round otherwise.
#pragma once

#include <algorithm>
#include <cstdint>
#include <initializer_list>
#include <optional>
#include <string>
#include <string_view>

namespace drape {

enum class Kernel : std::uint8_t {
    plain,            ///< one pass per step, from image to image
    buffer_store,     ///< every step: it stores through buffers of the images' memory
    explicit_stream,  ///< explicit steps: down the rows, four at once where nothing happens between them
    explicit_tile,    ///< explicit steps: in tiles of shared memory, several at once where nothing happens between them
    spring_stream,    ///< all springs of a relaxation iteration, down the rows
    spring_tile,      ///< all springs of a relaxation iteration, in tiles of shared memory
    twist_stream,     ///< the twist of all cells, down the rows
    twist_tile,       ///< the twist of all cells, in tiles of shared memory
    line_parts,       ///< long lines in parts, some particles per invocation: other rounding; no GPU has run it yet
    line_cyclic,      ///< lines by cyclic reduction, an invocation per particle: other rounding
};

/// The name of a kernel on the command line, in manifests and in `drape graph`.
struct KernelName {
    std::string_view name;
    Kernel kernel;
};
inline constexpr KernelName kernel_names[] = {
    {"plain", Kernel::plain},
    {"buffer_store", Kernel::buffer_store},
    {"explicit_stream", Kernel::explicit_stream},
    {"explicit_tile", Kernel::explicit_tile},
    {"spring_stream", Kernel::spring_stream},
    {"spring_tile", Kernel::spring_tile},
    {"twist_stream", Kernel::twist_stream},
    {"twist_tile", Kernel::twist_tile},
    {"line_parts", Kernel::line_parts},
    {"line_cyclic", Kernel::line_cyclic},
};
inline constexpr std::string_view name_of(Kernel kernel) { return kernel_names[static_cast<std::size_t>(kernel)].name; }

/// How large the workgroups may be that a kernel sizes by the scene, of which a device may allow less, and how many
/// invocations its subgroups have (what is given here is the default device's).
struct GroupLimits {
    std::uint32_t invocations = 1024, shared_bytes = 32768, subgroup = 8;
    bool operator==(const GroupLimits&) const = default;
};

/// A set of kernels that a simulation may use beside the plain ones; `auto` stands for those that suit the device and
/// the scene.
class Kernels {
  public:
    Kernels() = default;
    Kernels(std::initializer_list<Kernel> kernels) {
        for (const Kernel kernel : kernels) add(kernel);
    }
    static Kernels automatic() {
        Kernels kernels;
        kernels.automatic_ = true;
        return kernels;
    }
    /// Reads "auto", or names joined by commas; returns nothing where one is no kernel's.
    static std::optional<Kernels> parse(std::string_view text) {
        if (text == "auto") return automatic();
        Kernels kernels;
        while (true) {
            const std::string_view name = text.substr(0, text.find(','));
            const auto* const row = std::ranges::find(kernel_names, name, &KernelName::name);
            if (row == std::end(kernel_names)) return std::nullopt;
            kernels.add(row->kernel);
            if (name.size() == text.size()) return kernels;
            text.remove_prefix(name.size() + 1);
        }
    }
    /// Returns the text that `parse` reads.
    std::string text() const {
        if (automatic_) return "auto";
        std::string names;
        for (const auto& [name, kernel] : kernel_names)
            if (kernel != Kernel::plain && has(kernel)) names += (names.empty() ? "" : ",") + std::string(name);
        return names.empty() ? "plain" : names;
    }

    bool is_automatic() const { return automatic_; }
    bool has(Kernel kernel) const { return kernel == Kernel::plain || (bits_ >> static_cast<unsigned>(kernel) & 1u); }
    void add(Kernel kernel) { bits_ |= 1u << static_cast<unsigned>(kernel) & ~1u; }
    bool operator==(const Kernels&) const = default;

    GroupLimits group;

  private:
    std::uint32_t bits_ = 0;
    bool automatic_ = false;
};

/// Kernels that belong together.
inline const Kernels stream_kernels{Kernel::explicit_stream, Kernel::spring_stream, Kernel::twist_stream},
    tile_kernels{Kernel::explicit_tile, Kernel::spring_tile, Kernel::twist_tile}, cyclic_kernels{Kernel::line_cyclic},
    parts_kernels{Kernel::line_parts};

}  // namespace drape

// The declaration of a render graph: resources by versioned handles, passes with declared access. Building and planning
// need no device and are tested without one. `plan.h` turns a Graph into a Plan; `executor.h` records a Plan once and
// resubmits it.
#pragma once

#include <cstdint>
#include <functional>
#include <stdexcept>
#include <string>
#include <string_view>
#include <vector>

#include "shared/struct_layout.h"
#include "vulkan/api.h"

namespace drape::graph {

/// Thrown for a mistake of the programmer who declares passes: a stale handle, an undeclared access, a read of a
/// version that nobody wrote. The text names the pass and the resource.
class GraphError : public std::logic_error {
    using std::logic_error::logic_error;
};

enum class Access : std::uint8_t {
    compute_read,   ///< storage image or storage buffer
    compute_write,  ///< storage image or storage buffer
    vertex_read,    ///< storage image or storage buffer
    fragment_read,  ///< storage image or storage buffer
    index_read,     ///< index buffer
    indirect_read,  ///< buffer with the sizes of an indirect dispatch
    color_write,    ///< colour attachment (write, or load and write)
    depth_write,    ///< depth attachment (test and write)
    resolve_write,  ///< resolve target of a multisampled colour attachment
    transfer_read,
    transfer_write,
    host_read,  ///< after the frame's fence; makes device writes visible to the host
};
bool is_write(Access access);
std::string_view access_name(Access access);  ///< "compute_read"

/// How long a resource's contents live, and how many copies exist.
enum class Lifetime : std::uint8_t {
    transient,    ///< within a frame; its contents do not outlive the plan
    persistent,   ///< the state: carried from frame to frame; its final version is always wanted
    constant,     ///< written once in set-up; no pass may write it
    host_input,   ///< buffer: the host writes it before each submit; one copy per frame slot; no pass writes
    host_output,  ///< buffer: the host reads it after the frame; one copy per frame slot; always wanted
};

struct ImageDeclaration {
    std::string name;  ///< unique within the graph, e.g. "banner/position"; also the name of the physical image
    VkFormat format = VK_FORMAT_R32G32B32A32_SFLOAT;
    std::uint32_t width = 1, height = 1;
    VkSampleCountFlagBits samples = VK_SAMPLE_COUNT_1_BIT;
    Lifetime lifetime = Lifetime::transient;
    /// Shaders may bind the image as a storage image and as a storage buffer of texels (rows PassContext::row_pitch
    /// apart), according to the variable that a pass names. Both views are one resource with common hazards and
    /// versions. It stays in GENERAL, even if transient, so that every barrier is a memory barrier, which covers both
    /// views; an image barrier would not cover the buffer. Not every device supports this: call buffer_view_obstacle
    /// (executor.h) first.
    bool buffer_view = false;
    /// Passes may use bands of equally many rows, counted from the top, on their own, by these names (Handle::slice).
    /// For hazards and versions the image is one: a pass that uses a band uses the image. Bands in use share the
    /// image's memory, which is therefore created as for a buffer view and stays in GENERAL.
    std::vector<std::string> slices = {};
    bool stays_general() const { return buffer_view || !slices.empty(); }
};

struct BufferDeclaration {
    std::string name;
    std::uint64_t byte_count = 0;  ///< a positive multiple of 4
    Lifetime lifetime = Lifetime::transient;
    /// The type of its elements (glsl::layout_of); null: no shader may bind it.
    const glsl::StructLayout* element = nullptr;
    /// Shaders may also bind it as a buffer of rgba32f texels, an imageBuffer, according to the variable.
    bool texels = false;
};

/// A resource, or a slice of it, at a version. Writing returns a new handle and retires the old ones.
struct Handle {
    std::uint32_t resource = UINT32_MAX;
    std::uint32_t version = 0;
    std::uint32_t slice = UINT32_MAX;  ///< index into ImageDeclaration::slices; none: the whole image
    bool valid() const { return resource != UINT32_MAX; }
    bool operator==(const Handle&) const = default;
};

struct Resource {
    std::string name;
    bool is_image = false;
    ImageDeclaration image;    ///< set for an image
    BufferDeclaration buffer;  ///< set for a buffer
    Lifetime lifetime = Lifetime::transient;
    std::uint32_t version = 0;  ///< the newest version
    /// Returns the bytes of one copy: texels x texel size x samples, or the buffer's size. Throws VulkanError above 64
    /// bits.
    std::uint64_t byte_count() const;
    /// Returns the image that a handle refers to: the whole, or a slice as an image.
    ImageDeclaration seen(Handle handle) const;
    /// Returns the bytes of what a handle refers to.
    std::uint64_t byte_count(Handle handle) const;
};

struct Use {
    Handle handle;  ///< the version that is read, or the one that this write makes
    Access access;
    std::string variable;  ///< the compute shader's variable to which it is bound; empty: none
};

std::string_view lifetime_name(Lifetime lifetime);  ///< "persistent"

class PassContext;  // executor.h

struct Pass {
    std::string name;   ///< "banner/spring row even (substep 3)"
    std::string stage;  ///< the stage for timestamps: "simulate", "normals", "raster", "readback"
    std::string label;  ///< the name without counters; profiles sum the passes with the same label
    std::vector<Use> uses;
    std::function<void(PassContext&)> execute;
    double flops = 0;  ///< floating-point operations; 0: not known
};

/// A remark on the graph, which dumps show beside its passes, and its reason.
struct Remark {
    std::string what, reason;
};

class Graph;

/// The argument of a pass's set-up function, which is the only way to declare access.
class PassSetup {
  public:
    /// Declares a read of this version. A compute pass binds it to `variable`, GLSL's name of the storage image or of
    /// the storage buffer's array; draws name their variables when they are recorded (PassContext::bind). A read and
    /// then a write of one resource in one pass are a read-modify-write (each with its own variable; for one read-write
    /// descriptor the write alone names it); write then read throws. A variable serves one use.
    Handle read(Handle handle, Access access, std::string variable = {});
    /// Declares a write; returns the new version. Contents that the pass does not write stay (there is no implied
    /// clear).
    [[nodiscard]] Handle write(Handle handle, Access access, std::string variable = {});

  private:
    friend class Graph;
    PassSetup(Graph& graph, Pass& pass) : graph_(graph), pass_(pass) {}
    Graph& graph_;
    Pass& pass_;
};

struct PassName {
    std::string name, stage, label;
};

class Graph {
  public:
    /// Declares a resource; throws GraphError when the name is taken or the lifetime does not fit.
    Handle image(const ImageDeclaration& declaration);
    Handle buffer(const BufferDeclaration& declaration);
    /// Declares a buffer of `count` elements T, which shaders that bind it must know under the same name and layout.
    template <class T>
    Handle buffer(std::string name, std::uint64_t count, Lifetime lifetime) {
        return buffer({std::move(name), count * sizeof(T), lifetime, &glsl::layout_of<T>()});
    }
    /// Runs `setup` now, keeps `execute` for recording.
    void add_pass(PassName name, const std::function<void(PassSetup&)>& setup,
                  std::function<void(PassContext&)> execute);
    /// Adds to the floating-point operations of the newest pass, for profiles.
    void add_flops(double flops);
    /// Adds the remark, for every dump, that something was left out on purpose, and why.
    void skip(std::string what, std::string reason);
    /// Adds the remark that something requested is done only in part, and why.
    void compromise(std::string what, std::string reason);
    /// Adds the remark which of several ways of doing something was chosen, and why.
    void choose(std::string what, std::string reason);

    const std::vector<Resource>& resources() const { return resources_; }
    const std::vector<Pass>& passes() const { return passes_; }
    const std::vector<Remark>& skipped() const { return skipped_; }
    const std::vector<Remark>& compromises() const { return compromises_; }
    const std::vector<Remark>& choices() const { return choices_; }

  private:
    friend class PassSetup;
    std::vector<Resource> resources_;
    std::vector<Pass> passes_;
    std::vector<Remark> skipped_, compromises_, choices_;
};

}  // namespace drape::graph

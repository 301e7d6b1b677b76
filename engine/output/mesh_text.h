// Writes meshes as files, one per frame and cloth, in a format's representation of a mesh.
#pragma once

#include "output/frame_writer.h"

namespace drape {

/// A cloth in a frame, as in WrittenFrame.
struct WrittenMesh {
    std::span<const float> positions, velocities;
    std::span<const std::int16_t> contacts;
    std::span<const float> tensions, contact_forces;  ///< empty: not wanted
};

/// A collider in a frame.
struct PlacedCollider {
    const WrittenCollider& collider;
    std::vector<float> vertices;  ///< x y z each, m
};

/// How a format writes the file of a cloth, and the file of colliders in a world with this axis up.
struct MeshTexts {
    std::string (*cloth)(const WrittenCloth& cloth, const WrittenMesh& mesh);
    std::string (*colliders)(const std::vector<PlacedCollider>& colliders, Up up);
};

/// Returns the corners of all triangles, with the vertices numbered consecutively.
std::vector<std::uint32_t> joined_faces(const std::vector<PlacedCollider>& colliders);
/// Returns x y z of all vertices.
std::vector<float> joined_vertices(const std::vector<PlacedCollider>& colliders);

/// Returns a Wavefront OBJ: a vertex and a texture coordinate per particle of the list, which is sorted and has all
/// that the faces name, then the faces. Numbers have the fewest digits that read back as the same float.
std::string obj_text(const WrittenCloth& cloth, std::span<const float> xyzw,
                     const std::vector<std::uint32_t>& particles);

/// Writes mesh_0000.EXTENSION ..., or mesh_CLOTH_0000.EXTENSION for each of several cloths. Colliders that stand still
/// are in colliders.EXTENSION, those that move in colliders_0000.EXTENSION ...
class FaceSequence : public FrameWriter {
  public:
    FaceSequence(OutputFolder& folder, const WrittenRun& run, std::string extension, MeshTexts texts)
        : folder_(folder), run_(run), extension_(std::move(extension)), texts_(texts) {}

    void add(const WrittenFrame& frame) override;
    void set_faces(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint32_t>& faces) override;
    void set_springs(std::uint32_t frame, std::size_t cloth, const std::vector<std::uint8_t>& springs) override;
    std::vector<FileRecord> finish() override { return std::move(files_); }

  protected:
    OutputFolder& folder() const { return folder_; }
    const WrittenRun& run() const { return run_; }
    const std::vector<FileRecord>& files() const { return files_; }

  private:
    void add_colliders(std::uint32_t frame);
    void write_colliders(bool moving, const std::string& name, std::uint32_t frame);

    OutputFolder& folder_;
    /// The springs of a cloth, or else its faces, from a frame on that has not been added yet.
    struct Change {
        std::uint32_t frame;
        std::size_t cloth;
        std::vector<std::uint32_t> faces;
        std::vector<std::uint8_t> springs;
    };

    WrittenRun run_;               ///< has the faces of the frame that was added last
    std::vector<Change> changes_;  ///< in the order of their frames
    std::string extension_;
    MeshTexts texts_;
    std::vector<FileRecord> files_;
    bool still_written_ = false;  ///< colliders that stand still have been written
};

}  // namespace drape

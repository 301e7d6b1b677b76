// The binary parts of a glTF file.
#pragma once

#include <json/value.h>

#include <cstdint>
#include <filesystem>
#include <span>
#include <string>
#include <vector>

namespace drape::input {

/// The JSON of a glTF file with the bytes of its buffers. Errors name the file and the place in the JSON, as
/// "/accessors/3".
class GltfFile {
  public:
    /// Takes a .gltf, whose buffers are data URIs or files beside it, or a .glb. Throws OutputError.
    explicit GltfFile(const std::filesystem::path& path);

    const std::string& name() const { return name_; }
    const Json::Value& json() const { return json_; }

    /// Returns the object json[list][index], and where it stands. Throws OutputError where there is none.
    const Json::Value& object(const char* list, const Json::Value& index, std::string& place) const;
    /// Returns a whole number from 0 to 2^53, `otherwise` where there is none. Throws OutputError.
    std::uint64_t whole(const Json::Value& object, const std::string& place, const char* key,
                        std::uint64_t otherwise) const;

    /// The elements of an accessor, not yet read.
    struct Elements {
        std::span<const std::uint8_t> bytes;  ///< from the first element on
        std::uint64_t count, stride;
        int component;  ///< glTF's number of the type: 5126 is float
        std::string type, place;
        const std::uint8_t* at(std::uint64_t k) const { return bytes.data() + k * stride; }
    };
    /// Returns an accessor whose elements all lie within its buffer. Throws OutputError.
    Elements elements(const Json::Value& accessor) const;

    [[noreturn]] void fail(const std::string& place, const std::string& what) const;

  private:
    void read_glb(const std::vector<std::uint8_t>& bytes);
    void parse(std::span<const std::uint8_t> text);
    void read_buffers(const std::filesystem::path& folder);

    std::string name_;
    Json::Value json_;
    std::vector<std::vector<std::uint8_t>> buffers_;
    std::vector<std::uint8_t> glb_buffer_;
};

}  // namespace drape::input

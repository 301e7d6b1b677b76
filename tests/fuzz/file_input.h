// Readers of files get an input as a file in memory, always the same one.
#pragma once

#include <unistd.h>

#include <cmath>
#include <cstdio>
#include <cstdlib>
#include <filesystem>
#include <string>

#include "base/output_error.h"
#include "drape/error.h"
#include "fuzz.h"
#include "mesh/mesh_file.h"

namespace drape::fuzz {

/// A folder in memory, where the system has one, which goes with the process.
class Folder {
  public:
    Folder() {
        std::error_code code;
        const bool in_memory = std::filesystem::is_directory("/dev/shm", code) && access("/dev/shm", W_OK) == 0;
        std::string name = (in_memory ? "/dev/shm" : std::filesystem::temp_directory_path().string()) + "/drape_XXXXXX";
        require(mkdtemp(name.data()) != nullptr, "no folder for the input");
        path_ = name;
    }
    ~Folder() {
        std::error_code code;
        std::filesystem::remove_all(path_, code);
    }
    Folder(const Folder&) = delete;
    const std::filesystem::path& path() const { return path_; }

  private:
    std::filesystem::path path_;
};

/// Returns the path of a file of this name that holds the input.
inline std::filesystem::path file_with(const char* name, const std::uint8_t* data, std::size_t size) {
    static const Folder folder;
    std::filesystem::path path = folder.path() / name;
    std::FILE* const file = std::fopen(path.c_str(), "wb");
    require(file && std::fwrite(data, 1, size, file) == size && std::fclose(file) == 0, "the input is not written");
    return path;
}

/// Calls `read(path)`. An error must name the file.
template <class Read>
void read_file(const char* name, const std::uint8_t* data, std::size_t size, const Read& read) {
    const std::filesystem::path path = file_with(name, data, size);
    const auto expect_name = [&](const std::exception& error) {
        require(std::string(error.what()).find(name) != std::string::npos,
                std::string("an error that does not name its file: ") + error.what());
    };
    try {
        read(path);
    } catch (const Error& error) {
        expect_name(error);
    } catch (const OutputError& error) {
        expect_name(error);
    }
}

/// Reads a mesh file as a solid and as a shell; what is taken must be a body.
inline void read_mesh_file(const char* name, const std::uint8_t* data, std::size_t size) {
    const std::filesystem::path path = file_with(name, data, size);
    for (const std::optional<double> shell : {std::optional<double>(), std::optional<double>(0.01)}) {
        try {
            const auto mesh = read_mesh(path.string(), 1, shell);
            require(!mesh->triangles().empty(), "a mesh without triangles");
            for (const auto& triangle : mesh->triangles())
                for (const std::uint32_t corner : triangle) {
                    require(corner < mesh->vertices().size(), "a corner that is not there");
                    for (const double x : mesh->vertices()[corner])
                        require(std::isfinite(x), "a vertex that is not finite");
                }
        } catch (const Error& error) {
            require(std::string(error.what()).size() > 10, "an error that says nothing");
        }
    }
}

}  // namespace drape::fuzz

#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "output/atomic_file.h"
#include "output/output_folder.h"

namespace drape {

// Returns a hash, 32 hexadecimal digits, of everything that decides the bytes of a run's files: the scene, the
// picture's size, the program, the device.
std::string run_key(const std::vector<std::string>& parts);

// The numbers about a frame have names (Manifest::FrameStatistics).
using FrameValues = std::map<std::string, double>;
// Returns whether a name is that of a value that was put in (run/given_values.h), which the scene gives anew.
inline bool is_given(std::string_view name) { return name.starts_with("given_") || name.find("/given_") != name.npos; }

// Returns the text chunk of a frame's PNG: "<run key> frame <number>", and a JSON object of the frame's values when
// there are any, which a run that resumes need not compute again. Throws OutputError when one is not finite.
std::string frame_text(std::string_view run_key, std::uint64_t frame, const FrameValues& values = {});

struct KeptFrame {
    FileRecord file;
    FrameValues values;
};

// Returns the frames in the folder, by file name, for a run that resumes. Each file is decoded whole. Throws
// OutputError, changing nothing, that names the first frame that was drawn by a run with another key, stands under
// another frame's name, or cannot be read; or a finished run's manifest with another key (a folder of arrays has no
// frames to tell by).
std::map<std::string, KeptFrame> kept_frames(const OutputFolder& folder, const std::string& run_key);

}  // namespace drape

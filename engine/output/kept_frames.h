#pragma once

#include <cstdint>
#include <map>
#include <string>
#include <string_view>
#include <vector>

#include "output/atomic_file.h"
#include "output/output_folder.h"

namespace drape {

// Hash of everything that decides the bytes of a run's files: the scene, the picture's size, the program, the
// device. 32 hexadecimal digits.
std::string run_key(const std::vector<std::string>& parts);

// Numbers about a frame, by name (Manifest::FrameStatistics).
using FrameValues = std::map<std::string, double>;

// What the PNG of a frame carries in its text chunk: "<run key> frame <number>", and a JSON object of the
// frame's values when there are any: a run that resumes need not compute them again. Throws OutputError when
// one is not finite.
std::string frame_text(std::string_view run_key, std::uint64_t frame, const FrameValues& values = {});

struct KeptFrame {
    FileRecord file;
    FrameValues values;
};

// The frames in the folder, by file name, for a run that resumes. Each file is decoded whole. Throws
// OutputError naming the first frame that was drawn by a run with another key, stands under another frame's
// name, or cannot be read; nothing is changed. So is a finished run's manifest with another key (a folder of
// arrays has no frames to tell by).
std::map<std::string, KeptFrame> kept_frames(const OutputFolder& folder, const std::string& run_key);

}  // namespace drape

#include "output/section_file.h"

#include <fmt/format.h>
#include <xxhash.h>

#include <cstring>

#include "base/byte_stream.h"
#include "base/output_error.h"
#include "output/atomic_file.h"

namespace drape {

SectionChecksum section_checksum(std::span<const std::byte> bytes) {
    const XXH128_hash_t hash = XXH3_128bits(bytes.data(), bytes.size());
    SectionChecksum sum;
    std::memcpy(sum.data(), &hash.low64, 8);
    std::memcpy(sum.data() + 8, &hash.high64, 8);
    return sum;
}

std::vector<std::byte> encode_sections(const SectionFormat& format, const Sections& sections) {
    ByteWriter writer;
    writer.put_bytes(bytes_of(format.magic));
    writer(format.version, static_cast<std::uint32_t>(sections.size()));
    for (const auto& [name, bytes] : sections) {
        writer(name, std::uint64_t{bytes.size()});
        writer.put_bytes(bytes);
    }
    std::vector<std::byte> file = writer.take();
    const SectionChecksum sum = section_checksum(file);
    file.insert(file.end(), sum.begin(), sum.end());
    return file;
}

Sections decode_sections(const SectionFormat& format, std::span<const std::byte> bytes) {
    if (bytes.size() < format.magic.size() || std::memcmp(bytes.data(), format.magic.data(), format.magic.size()) != 0)
        throw OutputError(fmt::format("is no {}", format.what));
    const auto damaged = [](const char* why) { return OutputError(fmt::format("is damaged: {}", why)); };
    constexpr std::size_t sum_size = std::tuple_size_v<SectionChecksum>;
    if (bytes.size() < format.magic.size() + 2 * sizeof(std::uint32_t) + sum_size) throw damaged("it was cut short");
    const auto content = bytes.first(bytes.size() - sum_size);
    ByteReader reader(content.subspan(format.magic.size()));
    std::uint32_t version = 0, count = 0;
    reader(version, count);
    const SectionChecksum sum = section_checksum(content);
    const bool whole = std::memcmp(sum.data(), bytes.data() + content.size(), sum_size) == 0;
    // Another version may end with another checksum.
    if (version != format.version && (whole || version < 1000))
        throw OutputError(
            fmt::format("is a {} of version {}, and this program reads {}", format.what, version, format.version));
    if (!whole) throw damaged("its checksum does not fit");
    Sections sections;
    try {
        for (; count > 0; --count) {
            std::string name;
            std::uint64_t size = 0;
            reader(name, size);
            const auto part = reader.get_bytes(size);
            sections[name].assign(part.begin(), part.end());
        }
        if (reader.left() > 0) throw Error("something follows its sections");
    } catch (const Error& error) {
        throw damaged(error.what());
    }
    return sections;
}

}  // namespace drape

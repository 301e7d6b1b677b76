#include "output/zip_file.h"

#include <fmt/format.h>
#include <zip.h>

#include <cerrno>
#include <cstdio>
#include <exception>
#include <memory>

namespace drape {

namespace {

/// The archive as libzip sees it: a file to be written at any place up to its end.
struct Target {
    AtomicFile& file;
    std::uint64_t position = 0;
    std::exception_ptr failure;  ///< kept here, as it must not unwind through C
    zip_error_t error{};

    zip_int64_t write(const void* data, std::uint64_t count) {
        std::span<const std::byte> bytes(static_cast<const std::byte*>(data), count);
        try {
            const std::uint64_t over = std::min(count, file.size() - position);
            if (over > 0) file.rewrite(position, bytes.first(over));
            if (over < count) file.append(bytes.subspan(over));
        } catch (...) {
            failure = std::current_exception();
            zip_error_set(&error, ZIP_ER_WRITE, EIO);
            return -1;
        }
        position += count;
        return static_cast<zip_int64_t>(count);
    }
};

zip_int64_t target_command(void* user, void* data, zip_uint64_t count, zip_source_cmd_t command) {
    Target& target = *static_cast<Target*>(user);
    switch (command) {
        case ZIP_SOURCE_SUPPORTS:
            return ZIP_SOURCE_SUPPORTS_WRITABLE;
        case ZIP_SOURCE_STAT:
            zip_stat_init(static_cast<zip_stat_t*>(data));
            return 0;
        case ZIP_SOURCE_ERROR:
            return zip_error_to_data(&target.error, data, count);
        case ZIP_SOURCE_WRITE:
            return target.write(data, count);
        case ZIP_SOURCE_TELL_WRITE:
            return static_cast<zip_int64_t>(target.position);
        case ZIP_SOURCE_SEEK_WRITE: {
            const zip_int64_t place =
                zip_source_seek_compute_offset(target.position, target.file.size(), data, count, &target.error);
            if (place < 0) return -1;
            target.position = static_cast<std::uint64_t>(place);
            return 0;
        }
        default:
            return 0;
    }
}

[[noreturn]] void fail(zip_error_t* error) {
    const std::string text = zip_error_strerror(error);
    zip_error_fini(error);
    throw OutputError(fmt::format("ZIP: {}", text));
}

/// `source`, unless null, is owned by the archive or freed.
void add_part(zip_t* archive, const std::string& name, zip_source_t* source, bool deflates) {
    const zip_int64_t index = source ? zip_file_add(archive, name.c_str(), source, ZIP_FL_ENC_UTF_8) : -1;
    if (index < 0) {
        if (source) zip_source_free(source);
        fail(zip_get_error(archive));
    }
    const auto at = static_cast<zip_uint64_t>(index);
    constexpr zip_uint16_t first_date = 0x21;  // 1980-01-01
    constexpr zip_uint32_t usual_level = 6;    // 9 takes half as long again and gains nothing on coordinates
    if (zip_set_file_compression(archive, at, deflates ? ZIP_CM_DEFLATE : ZIP_CM_STORE, deflates ? usual_level : 0) !=
            0 ||
        zip_file_set_dostime(archive, at, 0, first_date, 0) != 0 ||
        zip_file_set_external_attributes(archive, at, 0, ZIP_OPSYS_UNIX, 0100644u << 16) != 0)
        fail(zip_get_error(archive));
}

}  // namespace

FileRecord ZipFile::commit() {
    Target target{file_, 0, {}, {}};
    zip_error_t error;
    zip_error_init(&error);
    zip_source_t* sink = zip_source_function_create(target_command, &target, &error);
    zip_t* opened = sink ? zip_open_from_source(sink, ZIP_CREATE | ZIP_TRUNCATE, &error) : nullptr;
    if (!opened) {
        if (sink) zip_source_free(sink);
        fail(&error);
    }
    std::unique_ptr<zip_t, void (*)(zip_t*)> archive(opened, zip_discard);
    for (const Part& part : parts_) {
        if (part.contents) {
            std::FILE* stream = fdopen(dup(part.contents->descriptor()), "rb");
            if (!stream) throw system_error_at("read the frames of", part.name, errno);
            add_part(opened, part.name, zip_source_filep(opened, stream, 0, -1), deflates_);
        } else {
            add_part(opened, part.name, zip_source_buffer(opened, part.bytes.data(), part.bytes.size(), 0), deflates_);
        }
    }
    if (zip_close(opened) != 0) {
        if (target.failure) std::rethrow_exception(target.failure);
        fail(zip_get_error(opened));
    }
    (void)archive.release();  // closing has freed it
    return file_.commit();
}

}  // namespace drape

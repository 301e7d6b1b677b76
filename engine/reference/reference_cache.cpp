#include "reference/reference_cache.h"

#include <unistd.h>

#include <atomic>
#include <bit>
#include <cstring>
#include <fstream>
#include <stdexcept>
#include <system_error>

#include "fmt/format.h"
#include "reference/stable_hash.h"

namespace drape {

namespace {

static_assert(std::endian::native == std::endian::little, "the file holds little-endian numbers");

constexpr std::string_view magic = "DRAPEREF";
constexpr std::uint64_t version = 1;

std::uint64_t hash_of(std::string_view bytes) {
    StableHash hash;
    hash.add(bytes);
    return hash.value();
}

/// The file holds magic, version, key, method, step, particles, times, then per time its estimate, order, positions and
/// velocities; at the end the hash of everything before. Texts are a length and their bytes; all numbers take 8 bytes.
class Writer {
  public:
    void bytes(std::string_view data) { data_.append(data); }
    void number(std::uint64_t value) { raw(&value, sizeof value); }
    void number(double value) { raw(&value, sizeof value); }
    void text(std::string_view value) {
        number(std::uint64_t{value.size()});
        bytes(value);
    }
    void vectors(const std::vector<Vec3>& values) { raw(values.data(), values.size() * sizeof(Vec3)); }
    const std::string& data() const { return data_; }

  private:
    void raw(const void* from, std::size_t size) { data_.append(static_cast<const char*>(from), size); }
    std::string data_;
};

/// Checks every read against the bytes that are left; after the first failure `ok()` stays false and values are 0.
class Reader {
  public:
    explicit Reader(std::string_view data) : rest_(data) {}
    bool ok() const { return ok_; }
    bool at_end() const { return ok_ && rest_.empty(); }
    std::string_view bytes(std::uint64_t size) {
        if (!ok_ || size > rest_.size()) {
            ok_ = false;
            return {};
        }
        const std::string_view result = rest_.substr(0, size);
        rest_.remove_prefix(size);
        return result;
    }
    template <class Number>
    Number number() {
        Number value{};
        const std::string_view from = bytes(sizeof value);
        if (ok_) std::memcpy(&value, from.data(), sizeof value);
        return value;
    }
    std::string_view text() { return bytes(number<std::uint64_t>()); }
    std::vector<Vec3> vectors(std::uint64_t count) {
        if (count > rest_.size() / sizeof(Vec3)) ok_ = false;
        const std::string_view from = bytes(ok_ ? count * sizeof(Vec3) : 0);
        std::vector<Vec3> result(ok_ ? count : 0);
        if (!result.empty()) std::memcpy(result.data(), from.data(), from.size());
        return result;
    }

  private:
    std::string_view rest_;
    bool ok_ = true;
};

std::string encoded(std::string_view key, const ReferenceRun& run) {
    Writer writer;
    writer.bytes(magic);
    writer.number(version);
    writer.text(key);
    writer.text(run.method);
    writer.number(run.step);
    writer.number(std::uint64_t{run.states.empty() ? 0 : run.states[0].position.size()});
    writer.number(std::uint64_t{run.times.size()});
    for (std::size_t k = 0; k < run.times.size(); ++k) {
        writer.number(run.times[k]);
        writer.number(run.error_estimate[k]);
        writer.number(run.observed_order[k]);
        writer.vectors(run.states[k].position);
        writer.vectors(run.states[k].velocity);
    }
    writer.number(hash_of(writer.data()));
    return writer.data();
}

std::optional<ReferenceRun> decoded(std::string_view data, std::string_view key) {
    if (data.size() < sizeof(std::uint64_t)) return std::nullopt;
    const std::string_view body = data.substr(0, data.size() - sizeof(std::uint64_t));
    if (Reader(data.substr(body.size())).number<std::uint64_t>() != hash_of(body)) return std::nullopt;
    Reader reader(body);
    if (reader.bytes(magic.size()) != magic || reader.number<std::uint64_t>() != version || reader.text() != key)
        return std::nullopt;
    ReferenceRun run;
    run.method = reader.text();
    run.step = reader.number<double>();
    const auto particles = reader.number<std::uint64_t>(), times = reader.number<std::uint64_t>();
    for (std::uint64_t k = 0; k < times && reader.ok(); ++k) {
        run.times.push_back(reader.number<double>());
        run.error_estimate.push_back(reader.number<double>());
        run.observed_order.push_back(reader.number<double>());
        NetworkState state;
        state.position = reader.vectors(particles);
        state.velocity = reader.vectors(particles);
        run.states.push_back(std::move(state));
    }
    if (!reader.at_end()) return std::nullopt;
    return run;
}

}  // namespace

std::string reference_key(std::string_view method, const SpringNetwork& network, std::span<const double> times,
                          std::initializer_list<std::pair<std::string_view, double>> options) {
    std::string key =
        fmt::format("drape reference; method {}; particles {}; springs {}; bending {}; network {:016x}", method,
                    network.particle_count(), network.springs.size(), network.bending.size(), network.fingerprint());
    for (const auto& [name, value] : options) key += fmt::format("; {} {:.17g}", name, value);
    key += "; times";
    for (const double time : times) key += fmt::format(" {:.17g}", time);
    return key;
}

ReferenceCache::ReferenceCache(std::filesystem::path folder) : folder_(std::move(folder)) {
    std::filesystem::create_directories(folder_);
}

std::filesystem::path ReferenceCache::file_of(std::string_view key) const {
    return folder_ / fmt::format("reference_{:016x}.bin", hash_of(key));
}

std::optional<ReferenceRun> ReferenceCache::load(std::string_view key) const {
    std::error_code error;
    if (!std::filesystem::is_regular_file(file_of(key), error)) return std::nullopt;
    const std::uintmax_t size = std::filesystem::file_size(file_of(key), error);
    if (error) return std::nullopt;
    std::string data(size, '\0');
    std::ifstream file(file_of(key), std::ios::binary);
    if (!file.read(data.data(), static_cast<std::streamsize>(size))) return std::nullopt;
    return decoded(data, key);
}

void ReferenceCache::store(std::string_view key, const ReferenceRun& run) const {
    static std::atomic<unsigned> counter{0};
    const std::filesystem::path target = file_of(key);
    const std::filesystem::path beside = fmt::format("{}.{}.{}.tmp", target.string(), getpid(), counter++);
    const std::string data = encoded(key, run);
    std::ofstream file(beside, std::ios::binary | std::ios::trunc);
    file.write(data.data(), static_cast<std::streamsize>(data.size()));
    file.close();
    std::error_code error;
    if (file) std::filesystem::rename(beside, target, error);
    if (!file || error) {
        std::error_code ignored;
        std::filesystem::remove(beside, ignored);
        throw std::runtime_error(
            fmt::format("{}: cannot keep the reference run{}", target.string(), error ? ": " + error.message() : ""));
    }
}

CachedRun ReferenceCache::get(std::string_view key, const std::function<ReferenceRun()>& compute) const {
    if (std::optional<ReferenceRun> kept = load(key)) return {std::move(*kept), true, {}};
    CachedRun result{compute(), false, {}};
    try {
        store(key, result.run);
    } catch (const std::runtime_error& error) {
        result.store_error = error.what();
    }
    return result;
}

}  // namespace drape

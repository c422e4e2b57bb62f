// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/session_store.hpp"

#include "lab/metrics/json.hpp"
#include "lab/runner/checksums.hpp"
#include "proto/disk/create.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <functional>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <stdexcept>
#include <sys/file.h>
#include <system_error>
#include <tuple>
#include <unistd.h>
#include <utility>

namespace hapnet::lab::runner {

namespace {

using Json = nlohmann::ordered_json;

constexpr int store_format = 1;

[[noreturn]] void refuse_file(const std::string& what, const std::string& path)
{
    throw std::system_error{errno, std::generic_category(),
                            fmt::format("cannot {} {}", what, path)};
}

Json header_of(const FolderIdentity& identity)
{
    return {{"format", store_format}, {"kind", identity.kind}, {"title", identity.title}};
}

std::optional<experiment::PlayedSession> played_from(const Json& line)
{
    if (!line.contains("metrics") || !line.value("rows", Json("")).is_string()) return std::nullopt;
    auto metrics = metrics::metrics_from(nlohmann::json(line["metrics"]));
    if (!metrics) return std::nullopt;
    experiment::PlayedSession played{*std::move(metrics), line.value("rows", std::string{}), {}};
    if (const auto apart = line.find("apart_m"); apart != line.end()) {
        if (!apart->is_number()) return std::nullopt;
        played.apart_m = apart->get<double>();
    }
    return played;
}

Json line_of(const std::string& key, const experiment::SessionSpec& spec,
             const experiment::PlayedSession& played)
{
    Json line{{"key", key},
              {"algorithm", spec.algorithm},
              {"network", experiment::network_text(spec.setting.profile)},
              {"metrics", to_json(played.metrics)}};
    if (!played.rows.empty()) line["rows"] = played.rows;
    if (played.apart_m) line["apart_m"] = *played.apart_m;
    return line;
}

/// The result of reading a file line by line. `use` is called with each line of the file, without
/// its end, and with the place where it begins. The result holds the length of the file, and
/// whether its last line has an end.
struct LinesRead {
    std::uint64_t length = 0;
    bool is_whole = true;
};
LinesRead for_each_line(const auto& file, const auto& use)
{
    constexpr std::size_t block = 1 << 20;
    LinesRead read;
    std::string text; // bytes after the last complete line
    while (true) {
        const auto kept = text.size();
        text.resize(kept + block);
        const auto count = ::pread(file.descriptor.number(), text.data() + kept, block,
                                   static_cast<off_t>(read.length));
        if (count < 0 && errno != EINTR) refuse_file("read", file.path);
        text.resize(kept + static_cast<std::size_t>(std::max<ssize_t>(count, 0)));
        if (count == 0) break;
        const auto begins = read.length - kept;
        read.length += text.size() - kept;
        std::size_t begin = 0;
        for (auto end = text.find('\n', kept); end != std::string::npos;
             end = text.find('\n', begin)) {
            use(std::string_view{text}.substr(begin, end - begin), begins + begin);
            begin = end + 1;
        }
        text.erase(0, begin);
    }
    read.is_whole = text.empty();
    if (!read.is_whole) use(std::string_view{text}, read.length - text.size());
    return read;
}

} // namespace

base::Result<std::unique_ptr<SessionStore>>
SessionStore::open(const std::string& path, const FolderIdentity& identity, std::string program)
{
    auto descriptor = disk::open_to_write(path, O_RDWR | O_APPEND, 0644);
    if (!descriptor) throw std::system_error{descriptor.error(), "cannot write " + path};
    const bool is_alone = flock(descriptor->number(), LOCK_EX | LOCK_NB) == 0;
    std::unique_ptr<SessionStore> store{new SessionStore{std::move(program)}};
    store->is_writable_ = true;
    store->files_.push_back({*std::move(descriptor), path});
    if (!is_alone) {
        return base::fail(path + " is in use by another run: wait for it, or choose another --out");
    }
    auto read = store->read_last(identity);
    if (!read) return tl::unexpected{std::move(read).error()};
    return store;
}

base::Result<std::unique_ptr<SessionStore>>
SessionStore::open_all(std::span<const std::string> paths, const FolderIdentity& identity,
                       std::string program)
{
    std::unique_ptr<SessionStore> store{new SessionStore{std::move(program)}};
    for (const std::string& path : paths) {
        disk::Descriptor descriptor{::open(path.c_str(), O_RDONLY | O_CLOEXEC)};
        if (!descriptor.is_open()) refuse_file("read", path);
        store->files_.push_back({std::move(descriptor), path});
        auto read = store->read_last(identity);
        if (!read) return tl::unexpected{std::move(read).error()};
    }
    return store;
}

SessionStore::SessionStore(std::string program) : program_{std::move(program)} {}

base::Result<void> SessionStore::read_last(const FolderIdentity& identity)
{
    const std::size_t number = files_.size() - 1;
    File& file = files_.back();
    const Json expected = header_of(identity);
    std::optional<Json> other; // unexpected header at the beginning of the file
    std::size_t lines = 0;
    const auto read = for_each_line(file, [&](std::string_view line, auto offset) {
        if (++lines > 1) {
            const Place place{number, offset, static_cast<std::uint32_t>(line.size())};
            if (other || take_line(line, place)) return;
            if (damaged_++ == 0) first_damaged_ = fmt::format("{}:{}", file.path, lines);
            return;
        }
        const Json header = Json::parse(line, nullptr, false);
        const bool is_expected = header == expected; // for invalid JSON, both == and != give false
        if (!is_expected) other = header;
    });
    file.length = read.length;
    if (other) {
        const Json title = other->is_object() ? other->value("title", Json{}) : Json{};
        return base::fail(fmt::format(
            "{} holds the sessions of {}: choose another --out, or remove that file", file.path,
            title.is_string() ? fmt::format("another experiment, '{}'", title.get<std::string>())
                              : "something else"));
    }
    if (!is_writable_) return {};
    if (read.length == 0) append(expected.dump());
    if (!read.is_whole) append(""); // the next session starts a new line
    return {};
}

bool SessionStore::take_line(std::string_view text, const Place& place)
{
    if (!has_right_sum(text)) return false;
    const Json line = Json::parse(text, nullptr, false);
    const bool has_key = line.is_object() && line.value("key", Json{}).is_string();
    if (!has_key || !played_from(line)) return false;
    Place& known = places_[std::hash<std::string>{}(line["key"].get<std::string>())];
    known = place;
    known.is_from_before = true;
    return true;
}

std::optional<std::string> SessionStore::damage() const
{
    if (damaged_ == 0) return std::nullopt;
    const bool is_one = damaged_ == 1;
    return fmt::format("{} {} the right checksum ({}{}): cut off, changed, or written by an older "
                       "version",
                       damaged_, is_one ? "line lacks" : "lines lack",
                       is_one ? "" : "the first is ", first_damaged_);
}

void SessionStore::append(const std::string& line)
{
    File& file = files_.front();
    const auto written = disk::write_all(file.descriptor.number(), line + '\n');
    if (written.error) { // remove the part of the line that was written
        std::ignore = ftruncate(file.descriptor.number(), static_cast<off_t>(file.length));
        throw std::system_error{written.error, "cannot write " + file.path};
    }
    file.length += written.bytes;
}

experiment::PlayedSession SessionStore::read_at(const Place& place, const std::string& key) const
{
    const File& file = files_[place.file];
    std::string text(place.length, '\0');
    const auto count = ::pread(file.descriptor.number(), text.data(), text.size(),
                               static_cast<off_t>(place.offset));
    if (count < 0) refuse_file("read", file.path);
    const Json line = has_right_sum(text) ? Json::parse(text, nullptr, false) : Json{};
    auto played =
        line.is_object() && line.value("key", Json{}) == key ? played_from(line) : std::nullopt;
    if (!played) throw std::runtime_error{file.path + " was changed by something else"};
    return *std::move(played);
}

std::optional<SessionStore::Place> SessionStore::place_of(const std::string& key)
{
    std::unique_lock lock{mutex_};
    changed_.wait(lock, [&] { return being_played_.count(key) == 0; });
    const auto known = places_.find(std::hash<std::string>{}(key));
    if (known == places_.end()) {
        being_played_.insert(key);
        return std::nullopt;
    }
    if (std::exchange(known->second.is_from_before, false)) ++counts_.reused;
    return known->second;
}

base::Result<experiment::PlayedSession> SessionStore::played(const experiment::SessionSpec& spec,
                                                             const experiment::PlaySession& play)
{
    const auto key = key_of(spec, program_);
    if (const auto place = place_of(key)) return read_at(*place, key);
    const auto leave = [this, &key, &spec](const base::Result<experiment::PlayedSession>& played) {
        const std::lock_guard lock{mutex_};
        being_played_.erase(key);
        changed_.notify_all();
        if (!played || !is_writable_) return;
        const std::string line = with_sum(line_of(key, spec, *played).dump());
        const Place place{0, files_.front().length, static_cast<std::uint32_t>(line.size())};
        append(line);
        places_.emplace(std::hash<std::string>{}(key), place);
        ++counts_.played;
    };
    try {
        auto played = play(spec);
        leave(played);
        return played;
    } catch (...) {
        leave(base::fail("thrown"));
        throw;
    }
}

SessionStore::Counts SessionStore::counts() const
{
    const std::lock_guard lock{mutex_};
    return counts_;
}

} // namespace hapnet::lab::runner

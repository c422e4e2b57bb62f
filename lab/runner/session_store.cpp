// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/runner/session_store.hpp"

#include "lab/metrics/json.hpp"

#include <algorithm>
#include <cerrno>
#include <fcntl.h>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <sys/file.h>
#include <system_error>
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
    return experiment::PlayedSession{*std::move(metrics), line.value("rows", std::string{})};
}

Json line_of(const std::string& key, const experiment::PlayedSession& played)
{
    Json line{{"key", key}, {"metrics", to_json(played.metrics)}};
    if (!played.rows.empty()) line["rows"] = played.rows;
    return line;
}

std::string whole_text(int descriptor, const std::string& path)
{
    std::string text;
    std::string block(1 << 16, '\0');
    while (true) {
        const auto count = ::read(descriptor, block.data(), block.size());
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) refuse_file("read", path);
        if (count == 0) return text;
        text.append(block, 0, static_cast<std::size_t>(count));
    }
}

} // namespace

base::Result<std::unique_ptr<SessionStore>>
SessionStore::open(const std::string& path, const FolderIdentity& identity, std::string program)
{
    const int descriptor = ::open(path.c_str(), O_RDWR | O_CREAT | O_APPEND | O_CLOEXEC, 0644);
    if (descriptor < 0) refuse_file("write", path);
    std::unique_ptr<SessionStore> store{new SessionStore{descriptor, path, std::move(program)}};
    if (flock(descriptor, LOCK_EX | LOCK_NB) != 0) {
        return base::fail(path + " is in use by another run: wait for it, or choose another --out");
    }
    auto read = store->read(identity);
    if (!read) return tl::unexpected{std::move(read).error()};
    return store;
}

SessionStore::SessionStore(int descriptor, std::string path, std::string program)
    : descriptor_{descriptor}, path_{std::move(path)}, program_{std::move(program)}
{}

SessionStore::~SessionStore() { close(descriptor_); }

base::Result<void> SessionStore::read(const FolderIdentity& identity)
{
    const std::string text = whole_text(descriptor_, path_);
    if (text.empty()) {
        append(header_of(identity).dump());
        return {};
    }
    bool is_first = true;
    for (std::size_t begin = 0; begin < text.size();) {
        const auto end = std::min(text.find('\n', begin), text.size());
        const Json line = Json::parse(text.substr(begin, end - begin), nullptr, false);
        begin = end + 1;
        if (std::exchange(is_first, false)) {
            if (line.is_object() && line == header_of(identity)) continue;
            return base::fail(fmt::format(
                "{} holds the sessions of {}: choose another --out, or remove that file", path_,
                line.is_object()
                    ? fmt::format("another experiment, '{}'", line.value("title", std::string{}))
                    : "something else"));
        }
        take_line(line);
    }
    if (text.back() != '\n') append(""); // the next session starts a new line
    return {};
}

void SessionStore::take_line(const nlohmann::ordered_json& line)
{
    const bool has_key = line.is_object() && line.value("key", Json{}).is_string();
    auto played = has_key ? played_from(line) : std::nullopt;
    if (!played) {
        ++damaged_;
        return;
    }
    const auto key = line["key"].get<std::string>();
    sessions_.insert_or_assign(key, *std::move(played));
    from_before_.insert(key);
}

void SessionStore::append(const std::string& line) const
{
    const std::string text = line + '\n';
    for (std::size_t written = 0; written < text.size();) {
        const auto count = write(descriptor_, text.data() + written, text.size() - written);
        if (count < 0 && errno == EINTR) continue;
        if (count < 0) refuse_file("write", path_);
        written += static_cast<std::size_t>(count);
    }
}

base::Result<experiment::PlayedSession> SessionStore::played(const experiment::SessionSpec& spec,
                                                             const experiment::PlaySession& play)
{
    const auto key = key_of(spec, program_);
    {
        std::unique_lock lock{mutex_};
        changed_.wait(lock, [&] { return being_played_.count(key) == 0; });
        if (const auto known = sessions_.find(key); known != sessions_.end()) {
            counts_.reused += from_before_.erase(key);
            return known->second;
        }
        being_played_.insert(key);
    }
    const auto leave = [this, &key](const base::Result<experiment::PlayedSession>& played) {
        const std::lock_guard lock{mutex_};
        being_played_.erase(key);
        changed_.notify_all();
        if (!played) return;
        sessions_.emplace(key, *played);
        append(line_of(key, *played).dump());
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

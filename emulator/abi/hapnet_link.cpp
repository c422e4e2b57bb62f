// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/abi/hapnet_link.h"

#include "emulator/core/direction_report.hpp"
#include "emulator/core/emulated_path.hpp"
#include "emulator/core/profile/presets.hpp"
#include "emulator/core/profile/settings.hpp"
#include "emulator/core/profile/text.hpp"
#include "proto/base/built_in.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/net/text_file.hpp"

#include <algorithm>
#include <array>
#include <chrono>
#include <cstddef>
#include <cstdint>
#include <cstring>
#include <deque>
#include <exception>
#include <nlohmann/json.hpp>
#include <optional>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

// The functions are C's, in no namespace.
using namespace hapnet;           // NOLINT(google-global-names-in-headers): no header
using namespace hapnet::emulator; // NOLINT(google-global-names-in-headers)

namespace {

/// The limits of the datagrams in flight on one link, in each direction.
constexpr auto limits = QueueLimits::within(std::size_t{64} << 20);
constexpr base::Duration budget = std::chrono::milliseconds{1};

base::TimePoint time_of(std::int64_t ns) { return base::TimePoint{base::Duration{ns}}; }
std::int64_t ns_of(base::TimePoint time) { return time.time_since_epoch().count(); }

/// Writes like snprintf(): truncated text also ends with a 0.
std::size_t write(std::string_view text, char* buffer, std::size_t size)
{
    if (size > 0) {
        const auto count = std::min(text.size(), size - 1);
        std::memcpy(buffer, text.data(), count);
        buffer[count] = '\0';
    }
    return text.size();
}

/// Returns the profile in a text, or the preset of that name. `folder`: null: no files can be
/// opened.
base::Result<Profile> profile_of(const std::string& text, const net::Folder* folder)
{
    const OpenFile open = [&](const std::string& name) -> base::Result<std::string> {
        if (folder != nullptr) return folder->text_of(name);
        return base::fail(fmt::format("this profile names the file '{}': create the link with the "
                                      "folder that has it (hapnet_link_create_in)",
                                      name));
    };
    const bool is_name = !text.empty() && text.find_first_of("\n=[#") == std::string::npos;
    if (!is_name) {
        auto profile = parse_profile(text, "profile", open);
        if (!profile || profile->flows.empty()) return profile;
        return base::fail("a link is one path and takes no [[flow]]: make a link for each flow");
    }
    const auto no_file = [](const std::string& name) -> base::Result<std::string> {
        return base::fail("cannot read " + name);
    };
    const auto preset = base::find_text(text, presets(), "a preset", no_file);
    if (!preset) return tl::unexpected{preset.error()};
    return parse_profile(preset->text, preset->source, open);
}

/// Returns the change that a setting makes to the path of the link.
base::Result<Set> set_of(std::string_view key, std::string_view value, const Path& path)
{
    const OpenFile no_files = [](const std::string& name) -> base::Result<std::string> {
        return base::fail(fmt::format("the file '{}' can be named in a profile alone", name));
    };
    const auto setting = parse_setting(key, value, no_files);
    if (!setting) return tl::unexpected{setting.error()};
    const std::array settings{*setting};
    const auto after = with_settings(path, settings);
    if (!after) return tl::unexpected{after.error()};
    return Set{patch_of(settings, {}, Direction::up, after->up),
               patch_of(settings, {}, Direction::down, after->down)};
}

} // namespace

struct hapnet_link {
    /// A packet that is due.
    struct Leaving {
        Direction direction{};
        Datagram datagram;
    };

    /// A packet without delay, with a copy of its bytes, because the path does not keep the bytes
    /// of such a packet.
    struct Untouched {
        Leaving leaving;
        std::vector<std::byte> bytes;
    };

    hapnet_link(const Profile& profile, std::uint64_t seed)
        : path{profile, {.seed = base::Seed{seed}, .limits = limits}}
    {}

    /// Follows the timeline step by step, like a daemon that wakes up for each step.
    void advance(std::int64_t now_ns)
    {
        now = std::max(now, time_of(now_ns));
        while (base::is_due(path.director().next_change(), now)) {
            path.advance(*path.director().next_change());
        }
        path.advance(now);
    }

    int push(Direction direction, std::span<const std::byte> bytes)
    {
        const Admission admission = path.on_packet(direction, bytes, now);
        fate.clear();
        const Path& now_hold = path.director().path();
        const bool has_column = !now_hold.up.regimes.empty() || !now_hold.down.regimes.empty();
        const RegimeNames names =
            regime_names(direction == Direction::up ? now_hold.up.regimes : now_hold.down.regimes);
        append_row(fate, direction, admission.number, admission.fate,
                   has_column ? &names : nullptr);
        if (admission.drop) return static_cast<int>(*admission.drop) + 1;
        if (admission.departure) {
            untouched.push_back({{direction, *admission.departure}, {bytes.begin(), bytes.end()}});
        }
        return 0;
    }

    /// Returns the earliest packet that is due; of packets due at the same time, up comes first. It
    /// stays the next one until leave().
    const Leaving* find_due()
    {
        if (next) return &*next;
        const auto up = path.link(Direction::up).next_deadline();
        const auto down = path.link(Direction::down).next_deadline();
        // Only what was pushed later can wait in the line of the same direction.
        const auto due = base::earlier(up, down);
        if (!untouched.empty() && !(due && *due < due_of_untouched())) {
            Untouched& first = untouched.front();
            first.leaving.datagram.bytes = first.bytes;
            next = first.leaving;
            return &*next;
        }
        const bool is_up_first = up && (!down || *up <= *down);
        for (const Direction direction : {is_up_first ? Direction::up : Direction::down,
                                          is_up_first ? Direction::down : Direction::up}) {
            if (const auto datagram = path.poll(direction, now)) {
                next = Leaving{direction, *datagram};
                return &*next;
            }
        }
        return nullptr;
    }

    void leave()
    {
        path.on_sent(next->direction, next->datagram, now);
        if (next->datagram.slot == Slab::no_slot) untouched.pop_front();
        next.reset();
    }

    [[nodiscard]] std::int64_t next_deadline() const
    {
        if (next) return ns_of(next->datagram.due);
        const auto due = path.next_due();
        if (untouched.empty() && !due) return HAPNET_LINK_NEVER;
        auto deadline = base::earlier(due, path.director().next_change());
        if (!untouched.empty())
            deadline = base::earlier(deadline, std::optional{due_of_untouched()});
        return ns_of(*deadline);
    }

    [[nodiscard]] base::TimePoint due_of_untouched() const
    {
        return untouched.front().leaving.datagram.due;
    }

    [[nodiscard]] nlohmann::ordered_json report(Direction direction) const
    {
        const Link& link = path.link(direction);
        return base::json_of(DirectionReport{.statistics = &link.statistics(),
                                             .stream = &link.stream_statistics().totals(),
                                             .budget = budget});
    }

    base::TimePoint now{};
    EmulatedPath path;
    std::deque<Untouched> untouched;
    std::optional<Leaving> next;
    std::string fate; // fate of the last pushed packet
};

namespace {

hapnet_link* create(const char* profile, const net::Folder* folder, std::uint64_t seed, char* error,
                    std::size_t error_bytes)
{
    const auto read = profile_of(profile, folder);
    if (!read) return write(read.error().message, error, error_bytes), nullptr;
    return new hapnet_link{*read, seed};
}

} // namespace

// No exception may leave a function that is called from C.

hapnet_link* hapnet_link_create(const char* profile, std::uint64_t seed, char* error,
                                std::size_t error_bytes)
{
    try {
        return create(profile, nullptr, seed, error, error_bytes);
    } catch (const std::exception& trouble) {
        write(trouble.what(), error, error_bytes);
        return nullptr;
    }
}

hapnet_link* hapnet_link_create_in(const char* profile, const char* folder, std::uint64_t seed,
                                   char* error, std::size_t error_bytes)
{
    try {
        const net::Folder files{folder};
        return create(profile, &files, seed, error, error_bytes);
    } catch (const std::exception& trouble) {
        write(trouble.what(), error, error_bytes);
        return nullptr;
    }
}

void hapnet_link_destroy(hapnet_link* link) { delete link; }

int hapnet_link_set(hapnet_link* link, const char* key, const char* value, std::int64_t now_ns,
                    char* error, std::size_t error_bytes)
{
    try {
        link->advance(now_ns);
        const auto set = set_of(key, value, link->path.director().path());
        const auto done = set ? link->path.apply(*set, link->now) : tl::unexpected{set.error()};
        if (!done) write(done.error().message, error, error_bytes);
        return done ? 0 : -1;
    } catch (const std::exception& trouble) {
        write(trouble.what(), error, error_bytes);
        return -1;
    }
}

int hapnet_link_push(hapnet_link* link, int direction, const void* bytes, std::size_t size,
                     std::int64_t now_ns)
{
    const bool is_direction = direction == HAPNET_LINK_UP || direction == HAPNET_LINK_DOWN;
    if (!is_direction || size > HAPNET_LINK_PACKET_MAX) return -1;
    try {
        link->advance(now_ns);
        return link->push(direction == HAPNET_LINK_UP ? Direction::up : Direction::down,
                          {static_cast<const std::byte*>(bytes), size});
    } catch (const std::exception&) {
        return -1;
    }
}

int hapnet_link_pop(hapnet_link* link, std::int64_t now_ns, void* buffer, std::size_t size,
                    hapnet_link_packet* packet)
{
    try {
        link->advance(now_ns);
        const auto* const leaving = link->find_due();
        if (leaving == nullptr) return 0;
        const Datagram& datagram = leaving->datagram;
        if (packet != nullptr) {
            *packet = {.number = datagram.number,
                       .arrived_ns = ns_of(datagram.arrival),
                       .due_ns = ns_of(datagram.due),
                       .size = datagram.size(),
                       .direction =
                           leaving->direction == Direction::up ? HAPNET_LINK_UP : HAPNET_LINK_DOWN,
                       .is_copy = datagram.is_copy ? 1 : 0};
        }
        if (size < datagram.size()) return -1;
        std::ranges::copy(datagram.bytes, static_cast<std::byte*>(buffer));
        link->leave();
        return 1;
    } catch (const std::exception&) {
        return -1;
    }
}

std::int64_t hapnet_link_next_deadline(const hapnet_link* link) { return link->next_deadline(); }

std::size_t hapnet_link_statistics(const hapnet_link* link, char* buffer, std::size_t size)
{
    try {
        const nlohmann::ordered_json both{{"up", link->report(Direction::up)},
                                          {"down", link->report(Direction::down)}};
        return write(both.dump(), buffer, size);
    } catch (const std::exception&) {
        return write("", buffer, size);
    }
}

std::size_t hapnet_link_fate(const hapnet_link* link, char* buffer, std::size_t size)
{
    return write(link->fate, buffer, size);
}

const char* hapnet_link_cause(int cause)
{
    const bool is_one = cause > 0 && static_cast<std::size_t>(cause) <= drop_causes.size();
    return is_one ? to_text(static_cast<DropCause>(cause - 1)).data() : nullptr;
}

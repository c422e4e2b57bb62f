// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/recorded_settings.hpp"

#include "device/governor/limits_text.hpp"
#include "device/mechanisms.hpp"
#include "peer/core/clock_policy.hpp"
#include "peer/core/shared_body.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/base/fields_json.hpp"
#include "proto/base/inplace_vector.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <cstdint>
#include <functional>
#include <optional>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::lab::records {

namespace {

struct WrittenMount {
    double scale = 0.0;
    std::array<double, 3> offset_m{};
};

constexpr auto fields_of(base::Tag<WrittenMount>)
{
    return base::fields("mount", base::member("scale", &WrittenMount::scale),
                        base::member("offset_m", &WrittenMount::offset_m));
}

/// The part of the configuration in a record's header on which the forces of the session depend.
struct WrittenConfig {
    std::uint16_t peer_id = 0;
    std::uint32_t nonce = 0;
    std::uint64_t seed = 0;
    std::uint64_t tick_ns = 0;
    double grip_damping_ns_per_m = 0.0;
    std::optional<double> stiffness_max_n_per_m{}; // older records do not have it
    double duration_s = 0.0;
    std::string task;
    std::optional<std::string> boot_id{};
    /// The ids of the other peers. Older records have one other peer and no list.
    std::optional<std::vector<std::uint16_t>> peers{};
    std::optional<std::uint16_t> wait_for{};
    std::string scene_toml;
    std::string algorithm_toml;
    std::optional<std::string> send{};      // older records do not have it
    std::optional<peer::Playout> playout{}; // older records do not have it
    std::optional<std::string> clock{};     // older records do not have it
    std::string governor_toml;
    WrittenMount mount{};
};

constexpr auto fields_of(base::Tag<WrittenConfig>)
{
    using Own = WrittenConfig;
    return base::fields(
        "config", base::member("peer_id", &Own::peer_id), base::member("nonce", &Own::nonce),
        base::member("seed", &Own::seed), base::member("tick_ns", &Own::tick_ns),
        base::member("grip_damping_ns_per_m", &Own::grip_damping_ns_per_m),
        base::member("stiffness_max_n_per_m", &Own::stiffness_max_n_per_m),
        base::member("duration_s", &Own::duration_s), base::member("task", &Own::task),
        base::member("boot_id", &Own::boot_id), base::member("peers", &Own::peers),
        base::member("wait_for", &Own::wait_for), base::member("scene_toml", &Own::scene_toml),
        base::member("algorithm_toml", &Own::algorithm_toml), base::member("send", &Own::send),
        base::member("playout", &Own::playout), base::member("clock", &Own::clock),
        base::member("governor_toml", &Own::governor_toml), base::member("mount", &Own::mount));
}

bool can_play(std::span<const std::uint16_t> others, std::uint16_t self)
{
    if (others.size() == 1) return others.front() != self;
    return !others.empty() && others.size() < peer::peers_max && others.front() != 0 &&
           std::ranges::adjacent_find(others, std::greater_equal{}) == others.end() &&
           std::ranges::find(others, self) == others.end();
}

/// Returns the reason why the session cannot be played again with these numbers; "" for none.
std::string_view validate(const WrittenConfig& config)
{
    constexpr double seconds_max = 1e6;
    constexpr std::uint64_t tick_ns = 1'000'000;
    if (config.nonce == 0) return "'nonce' is 0, which no run has";
    if (config.peer_id == 0) return "'peer_id' is 0, which no peer has";
    if (config.tick_ns != tick_ns) return "'tick_ns': only ticks of 1 ms can be played";
    if (!(config.duration_s > 0.0 && config.duration_s < seconds_max)) {
        return "'duration_s' is out of range";
    }
    if (!(config.grip_damping_ns_per_m >= 0.0)) return "'grip_damping_ns_per_m' is negative";
    if (!(config.stiffness_max_n_per_m.value_or(0.0) >= 0.0)) {
        return "'stiffness_max_n_per_m' is negative";
    }
    if (config.peers && !can_play(*config.peers, config.peer_id)) {
        return "'peers' are not up to seven others by their ids, ascending";
    }
    return config.mount.scale > 0.0 ? "" : "'mount': the scale is not positive";
}

/// Reads how the peer played these bodies with the others: its algorithm, and when it sent.
base::Result<void> read_play(const WrittenConfig& written, std::span<const peer::SharedBody> bodies,
                             peer::Settings& settings)
{
    auto algorithm = peer::parse_algorithm(written.algorithm_toml, "algorithm_toml");
    if (!algorithm) return tl::unexpected{algorithm.error()};
    settings.algorithm = *std::move(algorithm);
    if (settings.roster.others.size() > 1 && !peer::plays_with_many(settings.algorithm))
        return base::fail("its config: this algorithm is for two peers");
    if (const auto fine = peer::check_bodies_of(settings.algorithm, bodies); !fine)
        return base::fail("its config: 'algorithm_toml': " + fine.error().message);
    if (const auto fine = peer::check_hands_of(settings.algorithm, settings.scene.hands); !fine)
        return base::fail("its config: 'algorithm_toml': " + fine.error().message);
    const auto send = peer::parse_send_policy(written.send.value_or("every:1"));
    if (!send) return base::fail("its config: 'send': " + send.error().message);
    settings.send = *send;
    settings.playout = written.playout.value_or(peer::Playout::none);
    return {};
}

} // namespace

base::Result<void> check_wire(const nlohmann::json& config)
{
    const auto program = config.value(nlohmann::json::json_pointer{"/program"}, nlohmann::json(""));
    if (!program.is_string()) return base::fail("its config: 'program' is not a text");
    if (program != "hapnet-peer") return {};
    const auto wire =
        config.value(nlohmann::json::json_pointer{"/wire"}, nlohmann::json(1)); // none in version 1
    if (!wire.is_number_integer()) return base::fail("its config: 'wire' is not a whole number");
    if (wire == wire::protocol_version) return {};
    return base::fail(fmt::format("its messages are of version {} of the wire, and this program "
                                  "reads version {}: use the hapnet-lab of the version that "
                                  "recorded it",
                                  wire.dump(), wire::protocol_version));
}

base::Result<RecordedSettings> settings_of(const nlohmann::json& config)
{
    if (config.is_object() && config.value("begins_late", nlohmann::json{}) == true) {
        return base::fail("it begins late: it has only the last seconds of a session, and playing "
                          "again needs them from the start");
    }
    const auto written = base::from_json<WrittenConfig>(config, "its config");
    if (!written) {
        return base::fail(written.error().message +
                          ": was it recorded by this version of hapnet-peer?");
    }
    if (const auto fault = validate(*written); !fault.empty()) {
        return base::fail(fmt::format("its config: {}", fault));
    }
    const auto name = wire::TaskName::from_text(written->task);
    if (!name) return base::fail(fmt::format("its config: unknown task '{}'", written->task));

    RecordedSettings recorded;
    recorded.mount.scale = written->mount.scale;
    const auto& offset = written->mount.offset_m;
    recorded.mount.offset.value = {offset[0], offset[1], offset[2]};
    peer::Settings& settings = recorded.peer;
    settings.mount_scale = written->mount.scale;
    settings.introduction.id = written->peer_id;
    settings.introduction.nonce = written->nonce;
    if (written->peers) {
        const auto others = *written->peers;
        settings.roster.others.assign(others.begin(), others.end());
    }
    settings.roster.wait_for = written->wait_for.value_or(0);
    settings.introduction.seed = written->seed;
    settings.introduction.task = *name;
    const auto clock = peer::parse_clock_policy(written->clock.value_or("echo"));
    if (!clock) return base::fail("its config: 'clock': " + clock.error().message);
    settings.introduction.clock = clock_hash(*clock, written->boot_id.value_or(""));
    settings.introduction.clock_error = clock->synchronised_within.value_or(base::Duration{});
    settings.tick = base::Duration{static_cast<base::Duration::rep>(written->tick_ns)};
    settings.grip_damping_ns_per_m = written->grip_damping_ns_per_m;
    settings.stiffness_max_n_per_m = written->stiffness_max_n_per_m.value_or(0.0);
    settings.length = base::Duration{std::llround(written->duration_s * 1e9)};
    auto scene = scene::parse_scene(written->scene_toml, "scene_toml");
    if (!scene) return tl::unexpected{scene.error()};
    const auto bodies = peer::shared_bodies(*scene);
    if (!bodies) return base::fail("its config: 'scene_toml': " + bodies.error().message);
    settings.scene = *std::move(scene);
    settings.introduction.scene_hash = scene::hash(settings.scene);
    if (const auto fine = read_play(*written, *bodies, settings); !fine)
        return tl::unexpected{fine.error()};
    const auto limits =
        device::parse_limits(written->governor_toml, "governor_toml", device::known_mechanisms);
    if (!limits) return tl::unexpected{limits.error()};
    recorded.limits = *limits;
    return recorded;
}

} // namespace hapnet::lab::records

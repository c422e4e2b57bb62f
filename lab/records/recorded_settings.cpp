// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/recorded_settings.hpp"

#include "device/governor/limits_text.hpp"
#include "device/mechanisms.hpp"
#include "peer/core/shared_body.hpp"
#include "peer/core/sync/text.hpp"
#include "scene/text/text.hpp"

#include <cmath>
#include <concepts>
#include <limits>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::lab {

namespace {

/// Reads keys of one kind after the other and remembers the first that is not there.
class Config {
public:
    explicit Config(const nlohmann::json& json) : json_{json} {}

    template <std::unsigned_integral T>
    T whole(const char* key, T most = std::numeric_limits<T>::max())
    {
        const auto found = json_.find(key);
        const bool is_there = found != json_.end() && found->is_number_integer() && *found >= 0 &&
                              found->template get<std::uint64_t>() <= most;
        if (!is_there) miss(key, "whole number");
        return is_there ? found->template get<T>() : T{};
    }

    double number(const char* key)
    {
        const auto found = json_.find(key);
        const bool is_there = found != json_.end() && found->is_number();
        if (!is_there) miss(key, "number");
        return is_there ? found->get<double>() : 0.0;
    }

    /// As number(), of what older records have not.
    double number_if_any(const char* key, double otherwise)
    {
        return json_.contains(key) ? number(key) : otherwise;
    }

    std::string text(const char* key)
    {
        const auto found = json_.find(key);
        const bool is_there = found != json_.end() && found->is_string();
        if (!is_there) miss(key, "text");
        return is_there ? found->get<std::string>() : std::string{};
    }

    device::Mount mount(const char* key)
    {
        const auto at = [&](const char* part) {
            return json_.value(nlohmann::json::json_pointer{fmt::format("/{}/{}", key, part)},
                               nlohmann::json{});
        };
        device::Mount mount;
        bool is_there = at("scale").is_number() && at("scale") > 0.0;
        if (is_there) mount.scale = at("scale").get<double>();
        for (const int axis : {0, 1, 2}) {
            const auto part = at(fmt::format("offset_m/{}", axis).c_str());
            is_there = is_there && part.is_number();
            if (is_there) mount.offset.value[axis] = part.get<double>();
        }
        if (!is_there) miss(key, "mount");
        return mount;
    }

    [[nodiscard]] const std::optional<std::string>& complaint() const { return complaint_; }

private:
    void miss(const char* key, const char* what)
    {
        if (!complaint_) {
            complaint_ = fmt::format("its config has no {} \"{}\": was it recorded by this version "
                                     "of hapnet-peer?",
                                     what, key);
        }
    }

    const nlohmann::json& json_;
    std::optional<std::string> complaint_;
};

constexpr double seconds_max = 1e6;

} // namespace

base::Result<RecordedSettings> settings_of(const nlohmann::json& config)
{
    Config read{config};
    RecordedSettings recorded;
    peer::Settings& settings = recorded.peer;
    settings.introduction.id = read.whole<std::uint16_t>("peer_id");
    settings.introduction.nonce = read.whole<std::uint32_t>("nonce");
    settings.introduction.seed = read.whole<std::uint64_t>("seed");
    settings.tick = base::Duration{read.whole<std::uint64_t>("tick_ns", 1'000'000'000)};
    settings.grip_damping_ns_per_m = read.number("grip_damping_ns_per_m");
    settings.stiffness_max_n_per_m = read.number_if_any("stiffness_max_n_per_m", 0.0);
    const double seconds = read.number("duration_s");
    const std::string task = read.text("task");
    const std::string scene_text = read.text("scene_toml");
    const std::string algorithm_text = read.text("algorithm_toml");
    const std::string limits_text = read.text("governor_toml");
    recorded.mount = read.mount("mount");
    if (read.complaint()) return base::fail(*read.complaint());

    const auto name = wire::TaskName::from_text(task);
    if (!name) return base::fail("config \"task\": " + task + " is not a task");
    settings.introduction.task = *name;
    if (settings.tick != std::chrono::milliseconds{1}) {
        return base::fail("config \"tick_ns\": only ticks of 1 ms can be played");
    }
    if (!(seconds > 0.0 && seconds < seconds_max && settings.grip_damping_ns_per_m >= 0.0)) {
        return base::fail("config \"duration_s\" or \"grip_damping_ns_per_m\" is out of range");
    }
    if (!(settings.stiffness_max_n_per_m >= 0.0)) {
        return base::fail("config \"stiffness_max_n_per_m\" is negative");
    }
    settings.length = base::Duration{std::llround(seconds * 1e9)};
    auto scene = scene::parse_scene(scene_text, "scene_toml");
    if (!scene) return tl::unexpected{scene.error()};
    const auto body = peer::shared_body(*scene);
    if (!body) return base::fail("config \"scene_toml\": " + body.error().message);
    settings.scene = *std::move(scene);
    settings.introduction.scene_hash = scene::hash(settings.scene);
    auto algorithm = peer::parse_algorithm(algorithm_text, "algorithm_toml");
    if (!algorithm) return tl::unexpected{algorithm.error()};
    settings.algorithm = *std::move(algorithm);
    const auto limits =
        device::parse_limits(limits_text, "governor_toml", device::known_mechanisms);
    if (!limits) return tl::unexpected{limits.error()};
    recorded.limits = *limits;
    return recorded;
}

} // namespace hapnet::lab

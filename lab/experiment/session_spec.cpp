// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/session_spec.hpp"

#include "emulator/core/profile/text.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/base/ensure.hpp"
#include "proto/base/fields.hpp"
#include "proto/base/text.hpp"
#include "scene/text/text.hpp"

#include <memory>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::experiment {

namespace {

/// Returns a hash of 64 bits. Among 10^5 sessions two have the same hash by chance once in 10^9
/// experiments.
std::uint64_t hash_of(std::string_view text) { return base::Seed{}.stream(text).bits(0); }

/// Returns the scene for which a task of this number of peers is made.
scene::Description scene_for(device::Task task, std::size_t peers)
{
    const auto name = device::scene_of(task, peers);
    if (name == "paper") return scene::paper_scene();
    const auto built_in = scene::load_scene(
        std::string{name}, [](const std::string& file) { return base::fail(file); });
    base::ensure(built_in.has_value());
    return *built_in;
}

/// Returns the text of the prescribed motion of a hand; empty without one.
std::string way_text(std::string text, const std::shared_ptr<const device::HandTrace>& way)
{
    if (!way) return {};
    for (const device::HandMoment& moment : *way) {
        const auto& hip = moment.hip;
        text += fmt::format(" {} {} {} {} {}{}", moment.time_s, hip.x(), hip.y(), hip.z(),
                            moment.gripping, moment.docked ? " docked" : "");
    }
    return text + '\n';
}

/// Returns the times of a player's ticks; empty: it ticks evenly.
std::string ticks_text(const std::shared_ptr<const std::vector<base::Duration>>& ticks)
{
    if (!ticks) return {};
    std::string text = "ticks";
    for (const base::Duration tick : *ticks) text += fmt::format(" {}", tick.count());
    return text + '\n';
}

/// Returns the line of the key `send`; empty where each tick has a message.
std::string send_text(const peer::SendPolicy& send)
{
    return send.is_each_tick() ? "" : fmt::format("send = {}\n", text_of(send));
}

/// Returns the line of the key `playout`; empty where messages count as they arrive.
std::string playout_text(peer::Playout playout)
{
    return playout == peer::Playout::none ? ""
                                          : fmt::format("playout = {}\n", base::name_of(playout));
}

/// Returns the line of the key `clock`; empty where clocks are compared by echoes.
std::string clock_text(const peer::ClockPolicy& clock)
{
    return clock == peer::ClockPolicy{} ? "" : fmt::format("clock = {}\n", text_of(clock));
}

/// Returns the lines of the table `device`; empty for the device of the data sheet.
std::string device_text(const device::OmniPlant& plant)
{
    return plant == device::OmniPlant{} ? "" : base::field_lines(plant);
}

std::string player_text(const virtual_time::PlayerSetting& player)
{
    return fmt::format(
        "{}{}clock_ahead = {}\nphase = {}\n{}{}{}{}{}{}{}", peer::print_algorithm(player.algorithm),
        device::print_operator(player.person), player.clock_ahead.count(), player.phase.count(),
        way_text("replay", player.replay), way_text("script", player.way), ticks_text(player.ticks),
        send_text(player.send), playout_text(player.playout), clock_text(player.clock),
        device_text(player.omni));
}

/// Returns hashes of the contents of the files that a setting's text names. For example, the text
/// has only the name of a trace of delays.
std::string contents_text(const std::vector<NamedContents>& files, std::string_view setting)
{
    std::string text;
    for (const NamedContents& file : files) {
        const auto name = base::quoted(file.name);
        if (setting.find(name) != std::string_view::npos)
            text += fmt::format("contents of {} = {:016x}\n", name, file.hash);
    }
    return text;
}

} // namespace

SessionSpec make_session_spec(const Experiment& experiment, const SessionCase& one,
                              const emulator::Path& path)
{
    SessionSpec spec;
    spec.algorithm = one.algorithm.name;
    spec.files = experiment.files;
    virtual_time::Setting& setting = spec.setting;
    setting.task = one.task;
    setting.task_options = experiment.task_options;
    const auto& scene = one.party.scene;
    setting.scene = scene ? experiment.scenes[*scene].scene : scene_for(one.task, one.party.peers);
    setting.seed = base::Seed{one.seed};
    const hands::Trial* trial = one.hands.trial(one.trial);
    const bool is_own_length = experiment.is_as_long_as_scripts && trial != nullptr;
    setting.length = is_own_length ? session_length(trial->end_s()) : experiment.duration;
    setting.tick = experiment.tick;
    setting.energy_limit = experiment.energy_limit;
    setting.profile.path = path;
    setting.profile.paths = experiment.links;
    setting.profile.timeline = experiment.timeline;
    setting.players.resize(one.party.peers);
    for (std::size_t seat = 0; seat < setting.players.size(); ++seat) {
        setting.players[seat].algorithm = one.algorithm.algorithm;
        setting.players[seat].send = experiment.send;
        setting.players[seat].playout = experiment.playout;
        setting.players[seat].clock = experiment.clock;
        setting.players[seat].omni = experiment.device;
        // The worst that the stated error allows: one clock is ahead by it, the other behind.
        const auto error = experiment.clock.synchronised_within.value_or(base::Duration{});
        setting.players[seat].clock_ahead = seat % 2 == 0 ? -error : error;
        setting.players[seat].person = seat % 2 == 0 ? one.hands.left : one.hands.right;
        if (!experiment.replay.empty())
            setting.players[seat].replay = experiment.replay[seat % 2].trace;
        if (!experiment.script.empty())
            setting.players[seat].way = experiment.script[seat % 2].trace;
        if (trial != nullptr) setting.players[seat].way = trial->ways.at(seat % 2);
        if (experiment.keyed) setting.players[seat].circle = setting.seed;
    }
    return spec;
}

SessionSpec perfect_twin(const SessionSpec& spec)
{
    SessionSpec twin = spec;
    twin.setting.profile = {};
    for (auto& player : twin.setting.players) {
        player.clock = {};
        player.clock_ahead = {};
    }
    twin.rows_per_s = 0;
    return twin;
}

SessionSpec one_world_twin(const SessionSpec& spec)
{
    SessionSpec twin = spec;
    twin.setting = in_one_world(spec.setting);
    twin.rows_per_s = 0;
    twin.algorithm = "one world";
    return twin;
}

std::string network_text(const emulator::Profile& profile)
{
    std::string text;
    for (const char c : emulator::to_text(profile)) {
        if (c != '\n') {
            text += c;
        } else if (!text.empty() && !text.ends_with("; ")) {
            text += "; ";
        }
    }
    while (text.ends_with(' ') || text.ends_with(';')) text.pop_back();
    return text;
}

std::string key_of(const SessionSpec& spec, std::string_view program)
{
    const virtual_time::Setting& setting = spec.setting;
    std::string persons;
    std::string players;
    for (const virtual_time::PlayerSetting& player : setting.players) {
        persons += (persons.empty() ? "" : "/") + player.person.name;
        players += player_text(player) + '\n';
    }
    const auto label = fmt::format("{} {} {} seed {} {}", name_of(setting.task),
                                   peer::name_of(setting.players.front().algorithm), persons,
                                   setting.seed.value(), base::to_text(setting.length));
    const auto all = fmt::format("{}\n{}\n{}\n{}\n{}\n{}{}\n", label, program, setting.tick.count(),
                                 spec.rows_per_s, emulator::to_text(setting.profile), players,
                                 scene::to_text(setting.scene));
    // Each of these changes the key only where it is set, so that other keys stay the same.
    const std::string_view limit = setting.energy_limit ? "energy_limit = true\n" : "";
    const std::string_view keyed = setting.players.front().circle ? "keyed = true\n" : "";
    const auto silence =
        spec.silence ? fmt::format("silence = {}\n", spec.silence->count()) : std::string{};
    const bool is_usual = setting.task_options == device::TaskOptions{};
    const auto options = is_usual ? std::string{} : base::field_lines(setting.task_options);
    const std::string_view world = setting.is_one_world ? "one world\n" : "";
    const auto contents = contents_text(spec.files, all);
    return fmt::format("{} {:016x}", label,
                       hash_of(fmt::format("{}{}{}{}{}{}{}", all, limit, keyed, silence, options,
                                           world, contents)));
}

} // namespace hapnet::lab::experiment

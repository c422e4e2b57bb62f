// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/command_run.hpp"
#include "emulator/commands.hpp"
#include "emulator/core/profile/flows.hpp"
#include "emulator/scenario.hpp"
#include "emulator/wire_end.hpp"
#include "proto/net/child_command.hpp"
#include "proto/net/own_network.hpp"
#include "proto/net/program.hpp"
#include "proto/net/stop_signal.hpp"

#include <cstddef>
#include <memory>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

/// A command, and its end of the wire.
struct Place {
    char letter = 'A';
    std::string name; // "a"
    std::string address;
    std::string address_v6;
    WireEnd end{};
};

std::vector<Place> places_of(std::size_t count)
{
    std::vector<Place> places;
    for (std::size_t i = 0; i < count; ++i) {
        const std::size_t number = i + 1;
        Place place{.letter = static_cast<char>('A' + i),
                    .name = std::string(1, static_cast<char>('a' + i)),
                    .address = fmt::format("10.0.0.{}", number),
                    .address_v6 = fmt::format("fd00::{}", number)};
        place.end = {.wire = "wire-" + place.name,
                     .addresses = {{place.address, 24}, {place.address_v6, 64}}};
        auto& machine = place.end.machine.emplace();
        machine.front() = std::byte{2}; // a locally administered address
        machine.back() = static_cast<std::byte>(number);
        places.push_back(std::move(place));
    }
    return places;
}

net::ChildCommand::Setup setup_of(const std::vector<std::string>& words,
                                  const std::vector<Place>& places, std::size_t number)
{
    net::ChildCommand::Setup setup{.words = words,
                                   .has_own_network = true,
                                   .has_own_group = number > 0, // the terminal belongs to A
                                   .prepare = [end = places[number].end] { prepare(end); }};
    for (const bool is_v6 : {false, true}) {
        for (const Place& place : places) {
            const auto* const suffix = is_v6 ? "6" : "";
            const auto& address = is_v6 ? place.address_v6 : place.address;
            setup.environment.push_back(
                fmt::format("HAPNET_{}{}={}", place.letter, suffix, address));
            setup.hosts += fmt::format("{}\t{}{}\n", address, place.name, suffix);
        }
    }
    return setup;
}

FrameSession::Setup session_of(const BetweenOptions& options, const std::vector<Place>& places)
{
    FrameSession::Setup setup{.command = "between",
                              .frames = {.ends = {},
                                         .all_frames = options.frames.all_frames,
                                         .fix_checksums = options.frames.fix_checksums}};
    for (const Place& place : places) {
        setup.frames.ends.push_back({place.name, place.end.wire, place.end.machine});
    }
    return setup;
}

/// Returns the names that settings can use. With two commands, the only path has no name.
PathNames names_of(const ports::Frames::Setup& frames)
{
    if (frames.ends.size() > 2) return {.links = frames.path_names()};
    return {.without_links = "two commands have one path, whose keys are delay, up.delay and "
                             "down.delay"};
}

} // namespace

base::Result<int> run(const BetweenOptions& options)
{
    const auto places = places_of(options.commands.size());
    const auto setup = session_of(options, places);
    const auto scenario = scenario_of(options.run, names_of(setup.frames));
    if (!scenario) return tl::unexpected{scenario.error()};
    const auto fits = validate_for_frames(scenario->profile.flows, options.frames.all_frames);
    if (!fits) return tl::unexpected{fits.error()};
    const net::StopSignal stop{net::Hangup::stop};
    net::enter_own_network();
    std::vector<std::unique_ptr<net::ChildCommand>> commands;
    for (std::size_t i = 0; i < places.size(); ++i) {
        commands.push_back(
            std::make_unique<net::ChildCommand>(setup_of(options.commands[i], places, i)));
    }
    std::vector<CommandRun::Other> others;
    for (std::size_t i = 0; i < places.size(); ++i) {
        connect(*commands[i], places[i].end);
        if (i == 0) continue;
        others.push_back(
            {.process = *commands[i], .name = fmt::format("command {}", places[i].letter)});
    }
    const auto session = open_session(options.run, *scenario, setup);
    if (const auto fine = session->ensure_checks(); !fine) return tl::unexpected{fine.error()};
    session->announce();
    const int code = CommandRun{*commands.front(), others, *session, stop}.run();
    const bool is_fine = session->finish();
    const bool has_failed = session->failure() || (code == 0 && !is_fine);
    return has_failed ? net::exit_failed : code;
}

} // namespace hapnet::emulator

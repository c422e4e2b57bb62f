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

#include <spdlog/fmt/fmt.h>
#include <string>
#include <vector>

namespace hapnet::emulator {

namespace {

constexpr const char* address_a = "10.0.0.1";
constexpr const char* address_b = "10.0.0.2";
constexpr const char* address_a6 = "fd00::1";
constexpr const char* address_b6 = "fd00::2";

WireEnd end_of(const char* wire, const char* address, const char* address_v6)
{
    return {.wire = wire, .addresses = {{address, 24}, {address_v6, 64}}};
}

net::ChildCommand::Setup setup_of(const std::vector<std::string>& words, const WireEnd& end,
                                  bool has_terminal)
{
    return {.words = words,
            .has_own_network = true,
            .has_own_group = !has_terminal,
            .environment = {fmt::format("HAPNET_A={}", address_a),
                            fmt::format("HAPNET_B={}", address_b),
                            fmt::format("HAPNET_A6={}", address_a6),
                            fmt::format("HAPNET_B6={}", address_b6)},
            .hosts = fmt::format("{}\ta\n{}\tb\n{}\ta6\n{}\tb6\n", address_a, address_b, address_a6,
                                 address_b6),
            .prepare = [end] { prepare(end); }};
}

} // namespace

base::Result<int> run(const BetweenOptions& options)
{
    const auto scenario = scenario_of(options.run);
    if (!scenario) return tl::unexpected{scenario.error()};
    const auto fits = validate_for_frames(scenario->profile.flows, options.frames.all_frames);
    if (!fits) return tl::unexpected{fits.error()};
    const net::StopSignal stop{net::Hangup::stop};
    const auto end_a = end_of("wire-a", address_a, address_a6);
    const auto end_b = end_of("wire-b", address_b, address_b6);
    net::enter_own_network();
    net::ChildCommand a{setup_of(options.commands.first, end_a, /*has_terminal*/ true)};
    net::ChildCommand b{setup_of(options.commands.second, end_b, /*has_terminal*/ false)};
    connect(a, end_a);
    connect(b, end_b);
    const auto session = open_session(options.run, *scenario,
                                      {.command = "between",
                                       .frames = {.interface_a = end_a.wire,
                                                  .interface_b = end_b.wire,
                                                  .all_frames = options.frames.all_frames,
                                                  .fix_checksums = options.frames.fix_checksums}});
    if (const auto fine = session->ensure_checks(); !fine) return tl::unexpected{fine.error()};
    session->announce();
    const int code = CommandRun{a, {.process = b, .name = "command B"}, *session, stop}.run();
    const bool is_fine = session->finish();
    const bool has_failed = session->failure() || (code == 0 && !is_fine);
    return has_failed ? net::exit_failed : code;
}

} // namespace hapnet::emulator

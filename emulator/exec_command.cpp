// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/command_run.hpp"
#include "emulator/commands.hpp"
#include "emulator/core/profile/flows.hpp"
#include "emulator/scenario.hpp"
#include "emulator/wire_end.hpp"
#include "emulator/world.hpp"
#include "proto/net/child_command.hpp"
#include "proto/net/own_network.hpp"
#include "proto/net/program.hpp"
#include "proto/net/stop_signal.hpp"

#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::emulator {

namespace {

net::ChildCommand::Setup setup_of(const ExecOptions& options, const WireEnd& end)
{
    net::ChildCommand::Setup setup{.words = options.command,
                                   .has_own_network = true,
                                   .environment = {fmt::format("HAPNET_HOST={}", World::router)},
                                   .hosts = fmt::format("{}\thost\n", World::router),
                                   .name_servers = name_servers_of_world(),
                                   .prepare = [end] { prepare(end); }};
    if (end.router_v6.empty()) return setup;
    setup.environment.push_back(fmt::format("HAPNET_HOST6={}", end.router_v6));
    setup.hosts += fmt::format("{}\thost6\n", end.router_v6);
    return setup;
}

WireEnd end_of(const World& world)
{
    WireEnd end{.wire = "wire-a",
                .addresses = {{World::address_of_command, 24}},
                .router = World::router,
                .machine = World::machine_of_command};
    if (!world.has_ipv6()) return end;
    end.addresses.push_back({World::address_of_command_v6, 64});
    end.router_v6 = World::router_v6;
    return end;
}

} // namespace

base::Result<int> run(const ExecOptions& options)
{
    const auto scenario = scenario_of(options.run);
    if (!scenario) return tl::unexpected{scenario.error()};
    const auto fits = validate_for_frames(scenario->profile.flows, options.frames.all_frames);
    if (!fits) return tl::unexpected{fits.error()};
    const net::StopSignal stop{net::Hangup::stop};
    const std::string wire_b = "wire-b";
    World world{options.through, wire_b};
    const WireEnd end = end_of(world);
    net::enter_own_network();
    net::ChildCommand a{setup_of(options, end)};
    connect(a, end);
    world.open();
    const auto session = open_session(
        options.run, *scenario,
        {.command = "exec",
         .through = std::string{world.name()},
         .frames = {.ends = {{"a", end.wire}, {"b", wire_b}},
                    .all_frames = options.frames.all_frames,
                    .fix_checksums = options.frames.fix_checksums,
                    .cure_of_oversized = "pasta does not cut datagrams up, and these do not get "
                                         "through; slirp4netns does (--through slirp4netns)"}});
    if (const auto fine = session->ensure_checks(); !fine) return tl::unexpected{fine.error()};
    net::say("hapnet-emulator", fmt::format("the command reaches other networks through {}; this "
                                            "machine is {}{}{} there",
                                            world.name(), World::router,
                                            world.has_ipv6() ? " and " : "", end.router_v6));
    session->announce();
    const int code =
        CommandRun{
            a,
            {{.process = world.process(), .name = std::string{world.name()}, .runs_already = true}},
            *session,
            stop}
            .run();
    const bool is_fine = session->finish();
    const bool has_failed = session->failure() || (code == 0 && !is_fine);
    return has_failed ? net::exit_failed : code;
}

} // namespace hapnet::emulator

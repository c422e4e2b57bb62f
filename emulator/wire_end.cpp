// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/wire_end.hpp"

#include "proto/net/interface.hpp"
#include "proto/net/own_network.hpp"

#include <cerrno>
#include <span>
#include <spdlog/fmt/fmt.h>
#include <system_error>

namespace hapnet::emulator {

namespace {

constexpr const char* end_interface = "eth0";

} // namespace

void prepare(const WireEnd& end)
{
    net::set_up("lo");
    net::switch_off_offloads(end_interface);
    net::set_up(end_interface);
    for (const auto& [text, bits] : end.addresses) net::add_address(end_interface, text, bits);
    net::add_group_routes(end_interface);
    if (!end.router.empty()) net::add_default_route(end_interface, end.router);
    if (end.router_v6.empty()) return;
    net::ignore_router_advertisements(end_interface);
    net::add_default_route(end_interface, end.router_v6);
}

void connect(net::ChildCommand& command, const WireEnd& end)
{
    const auto machine =
        end.machine ? std::span<const std::byte>{*end.machine} : std::span<const std::byte>{};
    net::make_veth(end.wire, end_interface, command.pid(), machine);
    net::switch_off_offloads(end.wire);
    net::set_up(end.wire);
    command.prepare();
}

std::unique_ptr<FrameSession> open_session(const Options& options, const Scenario& scenario,
                                           const FrameSession::Setup& setup)
{
    try {
        return std::make_unique<FrameSession>(options, scenario, setup);
    } catch (const std::system_error& error) {
        const int code = error.code().value();
        if (code != EPERM && code != EACCES && code != EAFNOSUPPORT) throw;
        net::deny_network(
            code, fmt::format("cannot take the frames of {} (a packet socket, AF_PACKET): in a "
                              "container, allow it (with Docker: --cap-add NET_RAW --security-opt "
                              "seccomp=unconfined); elsewhere: modprobe af_packet",
                              setup.command));
    }
}

} // namespace hapnet::emulator

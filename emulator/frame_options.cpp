// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/frame_options.hpp"

#include "proto/cli/parsers.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::emulator {

namespace {

constexpr const char* between_description =
    "Runs two commands, A and B, each in a network of its own, with the emulator on the only wire "
    "between them: any protocol passes, not UDP alone. No root is needed where the system lets "
    "users make namespaces. With more commands, C, D and so on, there is a path between each two.\n"
    "\n"
    "A is 10.0.0.1 and fd00::1, B is 10.0.0.2 and fd00::2, and so on; all know them as $HAPNET_A, "
    "$HAPNET_B, $HAPNET_A6, $HAPNET_B6, and as the hosts a, b, a6 and b6. The others start first. "
    "A starts when all of them listen, after 1 s at the latest. When A ends, they get SIGTERM.";

constexpr const char* between_footer =
    R"(up is A to B, down is B to A. The conditions hold for each IP packet from the first one on;
ARP and the neighbour discovery of IPv6 pass undisturbed unless --all-frames is given. What the
commands print stays theirs: the emulator's own lines go to stderr. The terminal belongs to A; the
others read nothing.

With three to eight commands the paths are called a-b, a-c, b-c and so on; up of a-c is A to C.
Conditions hold on all of them, or on one: --set a-c.delay=80ms, --set a-c.up.loss=2%, or the
[matrix] of a profile.

Examples:
  hapnet-emulator between --delay 40ms -- ping -c 5 b --- sleep infinity
  hapnet-emulator between --delay 50ms --loss 0.1% -- iperf3 -c b --- iperf3 -s
  hapnet-emulator between --profile lte --stats run.json -- \
      curl -s http://b:8000/ --- python3 -m http.server 8000
  hapnet-emulator between --delay 20ms --set a-c.delay=80ms -- \
      sh -c 'ping -c 3 b; ping -c 3 c' --- sleep infinity --- sleep infinity)";

constexpr const char* between_exit_codes =
    R"(  N  as COMMAND_A ended; 128 + n when signal n killed it
  1  the run failed, or did not meet a --require or a [[check]] of its profile
  2  bad usage or input
  3  the system refused (no user namespaces, no such command))";

constexpr const char* exec_description =
    "Runs one command in a network of its own, with the emulator on its only wire; the other end "
    "of that wire is joined to the network of this machine by pasta (Debian's package passt) or "
    "slirp4netns. Any program meets the conditions so, without being told an address. No root is "
    "needed where the system lets users make namespaces.\n"
    "\n"
    "The command is 10.0.2.100. 10.0.2.2, $HAPNET_HOST and the host name host are this machine, "
    "also what listens on its loopback. TCP, UDP and the echoes of ping pass. Where this machine "
    "has a route of IPv6, the command is fd00::100, too, and this machine fd00::2, $HAPNET_HOST6 "
    "and host6.";

constexpr const char* exec_footer =
    R"(up is from the command to the network, down is back. The conditions hold for each IP packet
of the command, its questions to name servers too; ARP passes undisturbed unless --all-frames is
given. The terminal belongs to the command; the emulator's own lines go to stderr.

Examples:
  hapnet-emulator exec --delay 40ms --loss 1% -- curl https://example.org
  hapnet-emulator exec --profile lte --stats run.json -- bash
  hapnet-emulator exec --up.rate 1Mbit/s -- iperf3 -c "$SERVER")";

constexpr const char* exec_exit_codes =
    R"(  N  as COMMAND ended; 128 + n when signal n killed it
  1  the run failed, or did not meet a --require or a [[check]] of its profile
  2  bad usage or input
  3  the system refused (no user namespaces, neither pasta nor slirp4netns, no such command))";

constexpr const char* bridge_description =
    "Joins two network interfaces, as a switch with two ports and a bad cable would: what arrives "
    "at one leaves from the other, any protocol, VLAN tags and all. The ends keep their addresses "
    "and need not know of it. It needs root, or CAP_NET_RAW. The interfaces should have no "
    "addresses of their own.";

constexpr const char* bridge_footer =
    R"(up is from IF_A to IF_B. The conditions hold for each IP packet; ARP, the neighbour discovery
of IPv6 and what is not IP pass undisturbed unless --all-frames is given. What the emulator sent is
never forwarded. A loop, one machine that is heard on both sides, ends the run.

Examples:
  hapnet-emulator bridge eth1 eth2 --delay 40ms --loss 1%
  hapnet-emulator bridge eth1 eth2 --profile lte --control emulator.sock)";

constexpr const char* bridge_exit_codes = R"(  0  done
  1  the run failed, did not meet a --require or a [[check]], there is a loop, or an interface went
  2  bad usage or input
  3  the system refused (no CAP_NET_RAW, no such interface))";

base::Result<std::string> parse_interface(const std::string& text)
{
    constexpr std::size_t length_max = 15; // limit of Linux for interface names
    if (!text.empty() && text.size() <= length_max) return text;
    return base::fail(fmt::format("'{}' is not the name of an interface: it has 1 to {} characters",
                                  text, length_max));
}

} // namespace

std::span<char*> take_commands(std::span<char*> words, TypedCommands& commands)
{
    const auto is = [](std::string_view text) {
        return [text](const char* word) { return word == text; };
    };
    if (words.size() < 2) return words;
    const bool is_one = is("exec")(words[1]);
    if (!is_one && !is("between")(words[1])) return words;
    const auto dashes = std::ranges::find_if(words, is("--"));
    if (dashes == words.end()) return words;
    for (auto at = dashes; at != words.end();) {
        const auto begin = at + 1;
        at = is_one ? words.end() : std::find_if(begin, words.end(), is("---"));
        commands.emplace_back(begin, at);
    }
    return words.first(static_cast<std::size_t>(dashes - words.begin()));
}

void add_frame_options(cli::Command& command, FrameOptions& options)
{
    command.flag("--all-frames",
                 "The conditions also hold for ARP, neighbour discovery and what is not IP",
                 options.all_frames);
    command.flag("--fix-checksums",
                 "Give packets right checksums again after --corrupt: the receiver takes the "
                 "damage for data (default: it finds it, as on a damaged wire)",
                 options.fix_checksums);
}

cli::Command& add_between(cli::Command& program)
{
    cli::Command& command = program.command(
        "between", "Runs two commands or more with the emulator between them, any protocol");
    command.describe(between_description);
    command.add_usage(
        "-- COMMAND_A [ARGUMENT ...] --- COMMAND_B [ARGUMENT ...] [--- COMMAND_C ...]");
    command.add_footer(between_footer);
    command.add_exit_codes(between_exit_codes);
    return command;
}

cli::Command& add_exec(cli::Command& program, std::optional<WorldProgram>& through)
{
    cli::Command& command =
        program.command("exec", "Runs one command with the emulator between it and the network");
    command.describe(exec_description);
    command.add_usage("-- COMMAND [ARGUMENT ...]");
    command.add_footer(exec_footer);
    command.add_exit_codes(exec_exit_codes);
    command.option("--through", "pasta|slirp4netns",
                   "The program that joins the command's network to this machine's (default: the "
                   "first of them that works)",
                   cli::into(through, cli::named<WorldProgram>));
    return command;
}

cli::Command& add_bridge(cli::Command& program, std::string& a, std::string& b,
                         FrameOptions& options)
{
    cli::Command& command =
        program.command("bridge", "Joins two network interfaces, any protocol; needs root");
    command.describe(bridge_description);
    command.add_footer(bridge_footer);
    command.add_exit_codes(bridge_exit_codes);
    command.positional("IF_A", "The interface on A's side", cli::into(a, parse_interface))
        .required("eth1");
    command.positional("IF_B", "The interface on B's side", cli::into(b, parse_interface))
        .required("eth2");
    command.flag(
        "--icmp",
        "Tell the sender of a packet that --mtu drops, as a router would: ICMP "
        "\"fragmentation needed\", ICMPv6 \"packet too big\" (default: drop it in silence)",
        options.answers_too_big);
    return command;
}

base::Result<void> require_several_commands(const TypedCommands& commands)
{
    const auto is_empty = [](const auto& command) { return command.empty(); };
    if (commands.size() < 2 || std::ranges::any_of(commands, is_empty)) {
        return base::fail(
            "two commands are required, or more: hapnet-emulator between --delay 40ms -- ping "
            "-c 5 b --- sleep infinity");
    }
    if (commands.size() <= commands_max) return {};
    return base::fail(fmt::format("{} commands are too many: between runs at most {}. A '---' of a "
                                  "command's own hides in its quotes: sh -c 'command --- word'",
                                  commands.size(), commands_max));
}

base::Result<void> require_one_command(const TypedCommands& commands)
{
    if (!commands.empty() && !commands.front().empty()) return {};
    return base::fail("a command is required: hapnet-emulator exec --delay 40ms -- curl "
                      "https://example.org");
}

base::Result<void> require_two_interfaces(const std::string& a, const std::string& b)
{
    if (a != b) return {};
    return base::fail(fmt::format("IF_A and IF_B are both {}: a bridge joins two interfaces", a));
}

} // namespace hapnet::emulator

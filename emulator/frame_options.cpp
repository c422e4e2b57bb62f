// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/frame_options.hpp"

#include <algorithm>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::emulator {

namespace {

constexpr const char* between_description =
    "Runs two commands, A and B, each in a network of its own, with the emulator on the only wire "
    "between them: any protocol passes, not UDP alone. No root is needed.\n"
    "\n"
    "A is 10.0.0.1 and fd00::1, B is 10.0.0.2 and fd00::2; both know them as $HAPNET_A, $HAPNET_B, "
    "$HAPNET_A6, $HAPNET_B6, and as the hosts a, b, a6 and b6. B starts first. A starts when B "
    "listens, after 1 s at the latest. When A ends, B is told to.";

constexpr const char* between_footer =
    R"(up is A to B, down is B to A. The conditions hold for each IP packet from the first one on;
ARP and the neighbour discovery of IPv6 pass undisturbed. What the commands print
stays theirs: the emulator's own lines go to stderr. The terminal belongs to A; B reads nothing.

Examples:
  hapnet-emulator between --delay 40ms -- ping -c 5 b --- sleep infinity
  hapnet-emulator between --delay 50ms --loss 0.1% -- iperf3 -c b --- iperf3 -s
  hapnet-emulator between --profile lte --stats run.json -- \
      curl -s http://b:8000/ --- python3 -m http.server 8000)";

constexpr const char* between_exit_codes =
    R"(  N  as COMMAND_A ended; 128 + n when signal n killed it
  1  the run failed
  2  bad usage or input
  3  the system refused (no user namespaces, no such command))";

} // namespace

std::span<char*> take_commands(std::span<char*> words, TypedCommands& commands)
{
    const auto is = [](std::string_view text) {
        return [text](const char* word) { return word == text; };
    };
    if (words.size() < 2) return words;
    if (!is("between")(words[1]) && !is("exec")(words[1])) return words;
    const auto dashes = std::ranges::find_if(words, is("--"));
    if (dashes == words.end()) return words;
    const auto three = std::find_if(dashes + 1, words.end(), is("---"));
    commands.first.assign(dashes + 1, three);
    commands.has_second = three != words.end();
    if (commands.has_second) commands.second.assign(three + 1, words.end());
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
        "between", "Runs two commands with the emulator between them, any protocol");
    command.describe(between_description);
    command.add_footer(between_footer);
    command.add_exit_codes(between_exit_codes);
    return command;
}

base::Result<void> require_two_commands(const TypedCommands& commands)
{
    if (!commands.first.empty() && !commands.second.empty()) return {};
    return base::fail(
        "two commands are required: hapnet-emulator between --delay 40ms -- ping -c 5 "
        "b --- sleep infinity");
}

base::Result<void> require_one_command(const TypedCommands& commands)
{
    if (!commands.first.empty() && !commands.has_second) return {};
    return base::fail("one command is required: hapnet-emulator exec --delay 40ms -- curl "
                      "http://example.org/");
}

} // namespace hapnet::emulator

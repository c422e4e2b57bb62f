// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/options.hpp"

#include "proto/base/text.hpp"
#include "proto/cli/command.hpp"

#include <spdlog/fmt/fmt.h>

namespace hapnet::web {

namespace {

constexpr const char* description =
    "Shows running daemons on a page: the worlds of all peers, the network between them, and "
    "sliders that change it.";

constexpr const char* footer =
    R"(Prints one line when it listens: open http://127.0.0.1:PORT/#t=TOKEN. Whoever has the token
may look, change the emulator and, with --stage, start and stop simulated sessions. The page moves
no real hand.

The sockets are what the daemons were given as --control; they may come and go. Those of another
machine: ssh -L local.sock:remote.sock HOST.

Examples:
  hapnet-web --stage
  hapnet-web --lab /tmp/lab.sock
  hapnet-web --emulator /tmp/emulator.sock --peer /tmp/peer-1.sock --peer /tmp/peer-2.sock)";

constexpr const char* exit_codes = R"(  0  ended by SIGINT or SIGTERM
  1  it failed
  2  bad usage
  3  the system refused, or the port is taken)";

base::Result<std::uint16_t> port_of(const std::string& text)
{
    const auto port = base::parse_count(text, 65535);
    if (!port) return tl::unexpected{port.error()};
    return static_cast<std::uint16_t>(*port);
}

void add_options(cli::Command& program, Options& options)
{
    program.option("--emulator", "SOCKET", "The control socket of an emulator",
                   cli::into(options.emulator));
    program
        .option("--peer", "SOCKET", "The control socket of a peer; once for each",
                cli::onto(options.peers))
        .repeated();
    program.option("--lab", "SOCKET", "The control socket of hapnet-lab play, for virtual time",
                   cli::into(options.lab));
    program.flag("--stage", "Start an emulator and simulated peers, again and again",
                 options.stage);
    program.flag("--stopped", "With --stage: start nothing until the page asks for it",
                 options.keeps_stopped);
    program.flag("--virtual", "With --stage: begin in virtual time", options.is_virtual);
    program.option("--out", "DIR",
                   "With --stage: where records and captures go (default: a new folder below "
                   "results/)",
                   cli::into(options.out));
    program.option("--port", "PORT",
                   "Where to listen; 0 takes any (default 8460, or the next free)",
                   cli::into(options.port, port_of));
    program.option("--listen", "ADDRESS",
                   "Listen there besides loopback, in plain HTTP; needs --token-file and --host",
                   cli::into(options.listen));
    program
        .option("--host", "NAME[:PORT]", "Another name under which browsers may ask",
                cli::onto(options.hosts))
        .repeated();
    program.option("--token-file", "FILE",
                   "The token: 32 or more hexadecimal digits, in a file of mode 0600",
                   cli::into(options.token_file));
    program.option("--url-file", "FILE", "Write the address with its token there (mode 0600)",
                   cli::into(options.url_file));
}

/// Refuses options that exclude each other.
base::Result<void> check(const Options& options)
{
    const bool attaches = !options.emulator.empty() || !options.peers.empty();
    if (options.stage && (attaches || !options.lab.empty())) {
        return base::fail("--stage starts its own programs: leave --emulator, --peer and --lab "
                          "out");
    }
    if (attaches && !options.lab.empty()) {
        return base::fail("--lab is of virtual time: leave --emulator and --peer out");
    }
    const bool has_stage_options =
        !options.out.empty() || options.keeps_stopped || options.is_virtual;
    if (!options.stage && has_stage_options) {
        return base::fail("--out, --stopped and --virtual go with --stage");
    }
    if (options.peers.size() > 8) return base::fail("--peer: 8 at most");
    if (!options.listen.empty() && (options.token_file.empty() || options.hosts.empty())) {
        return base::fail("--listen needs --token-file FILE and --host NAME; or stay on loopback "
                          "and use ssh -L");
    }
    return {};
}

} // namespace

net::CommandLine<Options> parse_options(std::span<char*> words)
{
    Options options;
    cli::Command program{"hapnet-web", description};
    program.add_footer(footer);
    program.add_exit_codes(exit_codes);
    add_options(program, options);
    if (auto said = program.parse(words); !said || *said) return net::answer_of(std::move(said));
    options.is_port_chosen = program.is_given("--port");
    if (auto fine = check(options); !fine) return tl::unexpected{fine.error()};
    for (std::string& host : options.hosts) {
        if (host.find(':') == std::string::npos) host += fmt::format(":{}", options.port);
    }
    return options;
}

} // namespace hapnet::web

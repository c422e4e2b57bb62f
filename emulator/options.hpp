// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "emulator/core/queue_limits.hpp"
#include "emulator/file_options.hpp"
#include "emulator/frame_options.hpp"
#include "emulator/probe_options.hpp"
#include "emulator/tools/predict.hpp"
#include "emulator/typed_link.hpp"
#include "proto/base/condition.hpp"
#include "proto/base/names.hpp"
#include "proto/base/random.hpp"
#include "proto/base/time.hpp"
#include "proto/cli/keep_options.hpp"
#include "proto/net/address_set.hpp"
#include "proto/net/endpoint.hpp"
#include "proto/net/program.hpp"

#include <chrono>
#include <cstddef>
#include <cstdint>
#include <optional>
#include <span>
#include <string>
#include <string_view>
#include <variant>
#include <vector>

namespace hapnet::emulator {

/// The processor time that may be used for sending on time.
enum class Timing : std::uint8_t { eco, precise, spin };
constexpr auto names_of(base::Tag<Timing>) { return base::names("eco", "precise", "spin"); }

/// A setting of the conditions as it was typed: "up.delay", "300ms".
struct TypedSetting {
    std::string key;
    std::string value;
    std::string_view before_key = "--"; // what was typed before the key
};

/// The sources of the conditions. At this point no names have been resolved and no files opened.
struct ConditionOptions {
    std::optional<std::string> profile;            // a file, or the name of a preset
    std::string_view profile_option = "--profile"; // "": it was typed without an option
    std::optional<std::string> netem;              // a sentence as tc-netem takes it
    std::vector<TypedSetting> settings;            // override the profile
    std::optional<base::Seed> seed;                // overrides the profile's seed
};

/// A run: `hapnet-emulator --listen-a ... --listen-b ...`
struct Options {
    net::HostPort listen_a;
    net::HostPort listen_b;
    std::vector<net::AddressPattern> a; // none: adopt the first sender
    std::vector<net::AddressPattern> b;
    ConditionOptions conditions;
    std::optional<std::string> replay; // fates to apply instead of drawing
    Timing timing = Timing::precise;
    base::Duration budget = std::chrono::milliseconds{1};
    std::size_t in_flight_bytes = QueueLimits{}.bytes_max;
    std::size_t threads = 1;                // threads that relay, for a run with several paths
    std::optional<base::Duration> duration; // nullopt: until SIGINT or SIGTERM
    std::optional<std::string> stats;       // a file, or "-" for stdout
    std::optional<std::string> fates;
    std::optional<std::string> capture;
    std::optional<std::string> control;      // the path of a Unix socket
    std::optional<std::string> files;        // the folder whose files its clients may name
    cli::KeepOptions keep{};                 // the last seconds of the capture
    std::vector<base::Condition> required{}; // in addition to the profile's checks
};

/// A run with several links.
struct LinkOptions {
    std::vector<TypedLink> links;
    Options run; // the end addresses in it are not used
};

/// A run for any client of a server: `hapnet-emulator --listen ... --upstream HOST:PORT`
struct UpstreamOptions {
    net::HostPort listen;
    net::HostPort upstream;
    std::vector<net::AddressPattern> allowed; // clients that are served; empty: loopback
    std::size_t clients_max = 64;
    base::Duration idle = std::chrono::seconds{60};
    bool named_by_address = false; // a client's path is named by its address
    Options run;                   // the end addresses in it are not used
};

/// `hapnet-emulator between ... -- COMMAND_A --- COMMAND_B --- COMMAND_C ...`
struct BetweenOptions {
    FrameOptions frames;
    TypedCommands commands;
    Options run; // the end addresses in it are not used
};

/// `hapnet-emulator exec ... -- COMMAND`
struct ExecOptions {
    FrameOptions frames;
    std::optional<WorldProgram> through; // nullopt: the first that works
    std::vector<std::string> command;
    Options run; // the end addresses in it are not used
};

/// `hapnet-emulator bridge IF_A IF_B`
struct BridgeOptions {
    std::string a;
    std::string b;
    FrameOptions frames;
    Options run; // the end addresses in it are not used
};

/// `hapnet-emulator check PROFILE`
struct CheckOptions {
    ConditionOptions conditions;
    tools::Stream stream{.packets = 100'000}; // its `path` selects one of several
};

/// `hapnet-emulator predict PROFILE --rate 1000`
struct PredictOptions {
    ConditionOptions conditions;
    tools::Stream stream{}; // its `path` selects one of several
    /// The greatest number of packets to send until mean and deviation have settled; nullopt: the
    /// number in `stream`.
    std::optional<std::uint64_t> packets_max = 6'400'000;
    bool as_json = false;
};

using AnyOptions = std::variant<Options, LinkOptions, UpstreamOptions, BetweenOptions, ExecOptions,
                                BridgeOptions, CheckOptions, PredictOptions, VerifyOptions,
                                ReportOptions, LearnOptions, ProbeOptions>;

/// Reads the command line. The error names the option, what is wrong with it, and what would be
/// right.
[[nodiscard]] net::CommandLine<AnyOptions> parse_command_line(std::span<char*> words);

} // namespace hapnet::emulator

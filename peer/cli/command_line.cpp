// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "peer/cli/command_line.hpp"

#include "peer/doctor/findings.hpp"
#include "proto/base/text.hpp"

#include <CLI/CLI.hpp>
#include <functional>
#include <spdlog/fmt/fmt.h>
#include <string_view>

namespace hapnet::peer {

namespace {

constexpr const char* list_devices_description =
    "Lists every haptic device that can be seen without taking hold of it; for one that cannot\n"
    "be used, why and what to do. The first column is what --device takes. Every backend of them\n"
    "was never run on the physical device. Exit codes: 0 also when there is none, 2 bad usage.";
constexpr const char* doctor_description =
    "Looks at what this machine grants to a 1 kHz loop and to haptic devices, and says what to\n"
    "do where it could be better. Without a device only the loop matters: what it says of devices\n"
    "is for those who have one (never run on the physical device). Exit codes: 0 nothing is bad,\n"
    "2 bad usage, 3 something is bad.";
constexpr const char* self_test_description =
    "Tries a device through the governor, step by step, and reports what it found:\n"
    "  read       10 s without force: the rate at which the device speaks, drawn as a histogram\n"
    "  calibrate  what the device needs from you, such as its stylus in its holder, or its grip\n"
    "             moved to every stop; it says so\n"
    "  force      a ramp to 0.2 N to the right, only while you hold the primary button\n"
    "  cable      you pull the cable, and the loss has to be noticed\n"
    "Keep a loose grip, clear of the arm's way. --device sim shows what it looks like, without a\n"
    "device. Exit codes: 0 nothing failed, 1 a step failed, you broke the test off or the device\n"
    "went, 2 bad usage, 3 the device cannot be opened.";

/// Parses a command of a few options; what it says instead of running, or nullopt.
std::optional<base::Result<net::Answer>> parse(CLI::App& app, std::span<char*> words)
{
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::CallForHelp&) {
        return net::Answer{app.help()};
    } catch (const CLI::ParseError& error) {
        return base::fail(fmt::format("{}; see {} --help", error.what(), app.get_name()));
    }
    return std::nullopt;
}

net::CommandLine<Command> answer_of(base::Result<net::Answer> said)
{
    if (!said) return tl::unexpected{said.error()};
    return *std::move(said);
}

net::CommandLine<Command> parse_list_devices(std::span<char*> words)
{
    CLI::App app{list_devices_description, "hapnet-peer list-devices"};
    DeviceTexts texts;
    ListDevicesCommand command;
    add_finding_options(app, texts);
    app.add_flag("--json", command.json, "Print one JSON object instead of a table");
    if (const auto said = parse(app, words)) return answer_of(*said);
    Taker taker;
    take_finding(command.options, taker, texts);
    if (taker.error()) return base::fail(*taker.error());
    return command;
}

net::CommandLine<Command> parse_doctor(std::span<char*> words)
{
    CLI::App app{doctor_description, "hapnet-peer doctor"};
    DoctorCommand command;
    bool prints_rules = false;
    app.add_flag("--json", command.json, "Print one JSON object instead of a table");
    app.add_flag("--print-udev-rules", prints_rules,
                 "Print the udev rules of this version, and end");
    app.add_option("--hd-library", command.hd_library, "The vendor's library of hdapi devices")
        ->type_name("FILE");
    if (const auto said = parse(app, words)) return answer_of(*said);
    if (prints_rules) return net::Answer{std::string{doctor::udev_rules()}};
    return command;
}

net::CommandLine<Command> parse_self_test(std::span<char*> words)
{
    CLI::App app{self_test_description, "hapnet-peer self-test"};
    DeviceTexts texts;
    SelfTestCommand command;
    std::string read_for = "10s";
    add_device_options(app, texts);
    app.add_option("--skip", command.skip, "Leave a step out; may be said several times")
        ->type_name("STEP")
        ->check(CLI::IsMember(
            std::vector<std::string>{self_test_steps.begin(), self_test_steps.end()}));
    app.add_option("--read-for", read_for, "How long to read without force (default 10s)")
        ->type_name("TIME");
    app.add_option("--json", command.json, "Write the report to FILE, too")->type_name("FILE");
    if (const auto said = parse(app, words)) return answer_of(*said);
    Taker taker;
    taker.take(command.read_for, "--read-for", base::parse_duration(read_for));
    taker.require(command.read_for >= std::chrono::milliseconds{100} &&
                      command.read_for <= std::chrono::minutes{10},
                  "--read-for: from 100ms to 10min");
    taker.require(command.json != "-", "--json: '-' is not a file: the report needs one");
    taker.require(app.count("--device") > 0,
                  "--device is required: hapnet-peer list-devices shows what there is, and "
                  "--device sim tries the test itself");
    take_device(command.device, taker, texts);
    if (taker.error()) return base::fail(*taker.error());
    return command;
}

} // namespace

net::CommandLine<Command> parse_command_line(std::span<char*> words)
{
    const std::string_view first = words.size() > 1 ? words[1] : "";
    if (first == "list-devices") return parse_list_devices(words.subspan(1));
    if (first == "doctor") return parse_doctor(words.subspan(1));
    if (first == "self-test") return parse_self_test(words.subspan(1));
    auto line = parse_options(words);
    if (!line) return tl::unexpected{line.error()};
    if (auto* answer = std::get_if<net::Answer>(&*line)) return std::move(*answer);
    return std::get<Options>(*std::move(line));
}

} // namespace hapnet::peer

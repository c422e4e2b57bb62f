// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/dry_run.hpp"

#include "emulator/presets.hpp"
#include "proto/base/text.hpp"

#include <CLI/CLI.hpp>
#include <charconv>
#include <limits>
#include <spdlog/fmt/fmt.h>

namespace hapnet::emulator {

namespace {

struct DryRunTexts {
    std::optional<std::string> profile;
    std::optional<std::string> rate;
    std::optional<std::string> packets;
    std::optional<std::string> bytes;
    std::optional<std::string> seed;
    bool as_json = false;
    bool is_list = false;
};

/// The names of the presets, each followed by `separator`.
std::string preset_list(char separator)
{
    std::string list;
    for (const Preset& preset : presets()) list += std::string{preset.name} + separator;
    return list;
}

/// "1000" or "1000/s": datagrams a second.
base::Result<base::Duration> parse_spacing(std::string_view text)
{
    constexpr double fastest = 1e7;
    auto digits = text;
    if (digits.ends_with("/s")) digits.remove_suffix(2);
    double rate = 0.0;
    const auto [rest, error] = std::from_chars(digits.data(), digits.data() + digits.size(), rate);
    const bool is_number = error == std::errc{} && rest == digits.data() + digits.size();
    if (is_number && rate >= 1e-3 && rate <= fastest) return base::from_seconds(1.0 / rate);
    return base::fail(fmt::format("'{}' is not a rate: write packets a second, such as 1000 or "
                                  "1000/s; at most 10^7",
                                  text));
}

template <typename Target, typename Parse>
base::Result<void> read(const std::optional<std::string>& text, const char* option, Target& target,
                        Parse parse)
{
    if (!text) return {};
    const auto value = parse(*text);
    if (!value) return base::fail(fmt::format("{}: {}", option, value.error().message));
    target = static_cast<Target>(*value);
    return {};
}

net::CommandLine<DryRun> dry_run_from(const DryRunTexts& texts)
{
    if (texts.is_list) return net::Answer{preset_list('\n')};
    if (!texts.profile) {
        return base::fail("a profile is required: a file, or one of " + preset_list(' '));
    }
    DryRun run;
    run.profile = *texts.profile;
    run.as_json = texts.as_json;
    constexpr std::uint64_t packets_max = 1'000'000'000;
    constexpr std::uint64_t bytes_max = 65'507; // of UDP over IPv4
    const auto counted = [](std::uint64_t most) {
        return [most](const std::string& text) { return base::parse_count(text, most); };
    };
    auto done = read(texts.rate, "--rate", run.stream.spacing, parse_spacing);
    if (done) done = read(texts.packets, "--packets", run.stream.packets, counted(packets_max));
    if (done) done = read(texts.bytes, "--bytes", run.stream.bytes, counted(bytes_max));
    if (done && texts.seed) {
        std::uint64_t seed = 0;
        done = read(texts.seed, "--seed", seed, counted(std::numeric_limits<std::uint64_t>::max()));
        run.seed = base::Seed{seed};
    }
    if (done && run.stream.packets == 0) done = base::fail("--packets: at least 1");
    if (!done) return base::fail(done.error().message);
    return run;
}

net::CommandLine<DryRun> parse(CLI::App& app, DryRunTexts& texts, std::span<char*> words)
{
    app.set_help_flag("-h,--help", "Print this and exit");
    app.add_option("profile", texts.profile, "A profile: a file, or the name of a preset")
        ->type_name("FILE|NAME");
    app.add_flag("--list", texts.is_list, "Print the names of the presets and exit");
    app.add_option("--rate", texts.rate, "Datagrams a second, each way (default 1000)")
        ->type_name("RATE");
    app.add_option("--bytes", texts.bytes, "Payload of each datagram (default 144)")
        ->type_name("NUMBER");
    app.add_option("--seed", texts.seed, "Of all chance (default: the profile's, or 1)")
        ->type_name("NUMBER");
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::CallForHelp&) {
        return net::Answer{app.help()};
    } catch (const CLI::ParseError& error) {
        return base::fail(fmt::format("{} (--help lists the options)", error.what()));
    }
    return dry_run_from(texts);
}

} // namespace

base::Seed seed_of(const DryRun& run, const Profile& profile)
{
    return run.seed ? *run.seed : profile.seed.value_or(base::Seed{1});
}

net::CommandLine<DryRun> parse_check(std::span<char*> words)
{
    CLI::App app{
        "Reads a profile, prints it in canonical form, says what each stage does, and warns\n"
        "of what a stream of datagrams would meet that one may not have meant.",
        "hapnet-emulator check"};
    DryRunTexts texts;
    texts.packets = "100000";
    return parse(app, texts, words);
}

net::CommandLine<DryRun> parse_predict(std::span<char*> words)
{
    CLI::App app{
        "Plays a profile to a stream of datagrams in virtual time, through the link that real\n"
        "datagrams take, and prints what became of them beside what theory says.",
        "hapnet-emulator predict"};
    DryRunTexts texts;
    app.add_option("--packets", texts.packets, "How many, each way (default 400000)")
        ->type_name("NUMBER");
    app.add_flag("--json", texts.as_json, "Print JSON");
    return parse(app, texts, words);
}

} // namespace hapnet::emulator

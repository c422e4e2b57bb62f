// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/verify_command.hpp"

#include "emulator/core/fates/fates.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/core/verify/verify.hpp"
#include "proto/base/text.hpp"
#include "proto/net/program.hpp"

#include <CLI/CLI.hpp>
#include <cerrno>
#include <cstring>
#include <filesystem>
#include <fstream>
#include <iterator>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>

namespace hapnet::emulator {

namespace {

constexpr const char* description = "Tests whether the fates of a run are those that its profile "
                                    "promises: shares, runs and bursts\n"
                                    "of losses, the steps of their chains, delays, the directions "
                                    "against each other, and with the\n"
                                    "seed every fate.";

constexpr const char* footer =
    R"(RUN is a file that --fates has written, or a folder with fates.csv and profile.toml.
A test fails when a run that follows its profile would look like this one time in a million.
What cannot be told from so few datagrams, or from fates, is called unable.

Examples:
  hapnet-emulator verify run.csv --profile wifi.toml --seed 42 --rate 1000
  hapnet-emulator verify results/run-7 --json

Exit codes: 0 no test failed, 1 a test failed, 2 bad usage, or a file that cannot be used.)";

/// What the command line asks for.
struct Request {
    std::string run{};
    std::optional<std::string> profile{};
    std::optional<base::Seed> seed{};
    std::optional<base::Duration> spacing{};
    bool json = false;
};

using Text = std::optional<std::string>;

struct Texts {
    Text run;
    Text profile;
    Text seed;
    Text rate;
    bool json = false;
};

void add_options(CLI::App& app, Texts& texts)
{
    app.add_option("run", texts.run, "The fates of a run, or its folder (required)")
        ->type_name("RUN");
    app.add_option("--profile", texts.profile,
                   "What the run was to do (default: profile.toml in RUN)")
        ->type_name("FILE");
    app.add_option("--seed", texts.seed, "Of the run (default: the one in the profile)")
        ->type_name("NUMBER");
    app.add_option(
           "--rate", texts.rate,
           "Datagrams a second in each direction, if they came evenly: laws in time need it")
        ->type_name("NUMBER");
    app.add_flag("--json", texts.json, "Print one JSON object instead of a table");
}

base::Result<Request> request_from(const Texts& texts)
{
    if (!texts.run) return base::fail("RUN is required: hapnet-emulator verify run.csv");
    Request request{.run = *texts.run, .profile = texts.profile, .json = texts.json};
    if (texts.seed) {
        const auto seed = base::parse_count(*texts.seed, std::numeric_limits<std::uint64_t>::max());
        if (!seed) return base::fail(fmt::format("--seed: {}", seed.error().message));
        request.seed = base::Seed{*seed};
    }
    if (texts.rate) {
        constexpr std::uint64_t most = 1'000'000'000;
        const auto rate = base::parse_count(*texts.rate, most);
        if (!rate) return base::fail(fmt::format("--rate: {}", rate.error().message));
        if (*rate == 0) return base::fail("--rate: '0' is no rate: write datagrams a second");
        request.spacing = base::Duration{static_cast<base::Duration::rep>(most / *rate)};
    }
    return request;
}

net::CommandLine<Request> parse(std::span<char*> words)
{
    CLI::App app{description, "hapnet-emulator verify"};
    app.footer(footer);
    Texts texts;
    add_options(app, texts);
    try {
        app.parse(static_cast<int>(words.size()), words.data());
    } catch (const CLI::CallForHelp&) {
        return net::Answer{app.help()};
    } catch (const CLI::ParseError& error) {
        return base::fail(fmt::format("{} (see verify --help)", error.what()));
    }
    const auto request = request_from(texts);
    if (!request) return base::fail(request.error().message);
    return *request;
}

base::Result<std::string> read_file(const std::string& path)
{
    std::ifstream file{path, std::ios::binary};
    std::string text{std::istreambuf_iterator<char>{file}, {}};
    if (!file) return base::fail(fmt::format("cannot read {}: {}", path, std::strerror(errno)));
    return text;
}

/// Files that a profile names lie beside it.
base::Result<Profile> read_profile(const std::string& path)
{
    const auto text = read_file(path);
    if (!text) return base::fail(text.error().message);
    const auto folder = std::filesystem::path{path}.parent_path();
    return parse_profile(*text, path,
                         [&](const std::string& name) { return read_file(folder / name); });
}

nlohmann::json json_of(const std::vector<TestResult>& results)
{
    auto list = nlohmann::json::array();
    for (const TestResult& result : results) {
        list.push_back({{"test", result.name},
                        {"outcome", to_text(result.outcome)},
                        {"statistic", result.statistic},
                        {"p_value", result.p_value ? nlohmann::json(*result.p_value) : nullptr},
                        {"says", result.sentence}});
    }
    return list;
}

std::string json_of(const Verification& verification)
{
    const nlohmann::json json{{"passed", !verification.failed()},
                              {"up", json_of(verification.up)},
                              {"down", json_of(verification.down)},
                              {"between", json_of(verification.between)}};
    return json.dump(2) + "\n";
}

base::Result<int> verify_run(const Request& request)
{
    const bool is_folder = std::filesystem::is_directory(request.run);
    const auto inside = [&](const char* name) {
        return (std::filesystem::path{request.run} / name).string();
    };
    if (!is_folder && !request.profile) {
        return base::fail(fmt::format("--profile is required: {} is not a folder with a "
                                      "profile.toml",
                                      request.run));
    }
    const auto fates_path = is_folder ? inside("fates.csv") : request.run;
    const auto text = read_file(fates_path);
    if (!text) return base::fail(text.error().message);
    const auto fates = parse_fates(*text);
    if (!fates) return base::fail(fmt::format("{}: {}", fates_path, fates.error().message));
    const auto profile = read_profile(request.profile.value_or(inside("profile.toml")));
    if (!profile) return base::fail(profile.error().message);
    if (!profile->timeline.empty()) {
        return base::fail("the profile changes during the run: only what holds from the first "
                          "datagram to the last can be verified");
    }
    const Claim claim{.path = profile->path,
                      .seed = request.seed ? request.seed : profile->seed,
                      .spacing = request.spacing};
    const auto verification = verify(claim, fates->up, fates->down);
    fmt::print("{}", request.json ? json_of(verification) : to_text(verification));
    return verification.failed() ? net::exit_failed : 0;
}

} // namespace

int verify_program(std::span<char*> words)
{
    return net::run_program("hapnet-emulator", parse(words), verify_run);
}

} // namespace hapnet::emulator

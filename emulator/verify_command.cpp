// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/verify_command.hpp"

#include "emulator/core/fates/fates.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/fates_file.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/tools/verify/verify.hpp"
#include "proto/base/text.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <CLI/CLI.hpp>
#include <filesystem>
#include <fstream>
#include <limits>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::emulator {

namespace {

constexpr const char* verify_description =
    "Tests whether the fates of a run are those that its profile "
    "promises: shares, runs and bursts\n"
    "of losses, the steps of their chains, delays, the directions "
    "against each other, and with the\n"
    "seed every fate.";

constexpr const char* verify_footer =
    R"(RUN is the file that --stats has written of a run with --fates; or the file that --fates has
written, with --profile; or a folder with fates.csv and profile.toml.
A test fails when a run that follows its profile would look like this one time in a million.
What cannot be told from so few datagrams, or from fates, is called unable.

Examples:
  hapnet-emulator verify run.json
  hapnet-emulator verify fates.csv --profile wifi-busy --seed 42 --rate 1000
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

struct VerifyTexts {
    Text run;
    Text profile;
    Text seed;
    Text rate;
    bool json = false;
};

void add_options(CLI::App& app, VerifyTexts& texts)
{
    app.add_option("run", texts.run, "What a run has written (required)")->type_name("RUN");
    app.add_option("--profile", texts.profile, "What the run was to do (default: what RUN says)")
        ->type_name("FILE|NAME");
    app.add_option("--seed", texts.seed, "Of the run (default: the one in the profile)")
        ->type_name("NUMBER");
    app.add_option(
           "--rate", texts.rate,
           "Datagrams a second in each direction, if they came evenly: laws in time need it")
        ->type_name("NUMBER");
    app.add_flag("--json", texts.json, "Print one JSON object instead of a table");
}

base::Result<Request> request_from(const VerifyTexts& texts)
{
    if (!texts.run) return base::fail("RUN is required: hapnet-emulator verify run.json");
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
    CLI::App app{verify_description, "hapnet-emulator verify"};
    app.footer(verify_footer);
    VerifyTexts texts;
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

/// The fates of a run, and the profile that they are to follow.
struct Evidence {
    Fates fates;
    Profile profile;
};

base::Result<Evidence> evidence_in(const std::string& fates_path, base::Result<Profile> profile)
{
    auto fates = read_fates(fates_path);
    if (!fates) return tl::unexpected{fates.error()};
    if (!profile) return tl::unexpected{profile.error()};
    return Evidence{*std::move(fates), *std::move(profile)};
}

/// Whether the fates are those of all datagrams that the statistics count. Rows that are missing at
/// the end of the table leave no gap in it.
base::Result<Evidence> all_there(Evidence evidence, const nlohmann::json& statistics)
{
    const auto& [up, down] = evidence.fates;
    for (const auto& [direction, fates] : {std::pair{"up", &up}, std::pair{"down", &down}}) {
        const auto way = statistics.value(direction, nlohmann::json::object());
        const auto received = way.find("received");
        if (received == way.end() || *received == fates->size()) continue;
        return base::fail(fmt::format("the statistics count {} datagrams {}, and the fates are "
                                      "those of {}: they are not complete, or of another run",
                                      received->dump(), direction, fates->size()));
    }
    return evidence;
}

/// What --stats has written: it holds the profile and names the fates.
base::Result<Evidence> evidence_of_statistics(const Request& request, const std::string& text)
{
    const std::string& path = request.run;
    const auto json = nlohmann::json::parse(text, nullptr, /*allow_exceptions*/ false);
    const auto text_at = [&](const char* key) -> std::string {
        return json.is_object() && json.contains(key) && json[key].is_string()
                   ? json[key].get<std::string>()
                   : "";
    };
    if (!text_at("replay").empty()) {
        return base::fail(fmt::format("{} replayed {}: its fates are those, whatever its "
                                      "conditions say; verify the run that wrote them",
                                      path, text_at("replay")));
    }
    const std::string fates = text_at("fates");
    if (fates.empty()) {
        return base::fail(fmt::format("{} names no fates: run with --fates and --stats", path));
    }
    if (json.contains("generation") && json["generation"] != 1) {
        return base::fail("the conditions changed during the run: only what holds from the first "
                          "datagram to the last can be verified");
    }
    if (const auto replayed = text_at("replay"); !replayed.empty() && !request.profile) {
        return base::fail(fmt::format("{} is of a run whose fates were replayed from {}: say with "
                                      "--profile what they are to follow",
                                      path, replayed));
    }
    const auto beside = path_beside(std::filesystem::path{fates}.filename().string(), path);
    const auto open = [&](const std::string& name) {
        return net::text_of_file(path_beside(name, path));
    };
    const auto profile = request.profile ? load_profile(*request.profile)
                                         : parse_profile(text_at("profile"), path, open);
    auto evidence = evidence_in(std::filesystem::exists(fates) ? fates : beside, profile);
    if (!evidence) return evidence;
    return all_there(*std::move(evidence), json);
}

base::Result<Evidence> evidence_of(const Request& request)
{
    if (std::filesystem::is_directory(request.run)) {
        const auto inside = [&](const char* name) {
            return (std::filesystem::path{request.run} / name).string();
        };
        return evidence_in(inside("fates.csv"),
                           load_profile(request.profile.value_or(inside("profile.toml"))));
    }
    // Fates may be larger than what text_of_file() takes.
    const bool is_json = std::ifstream{request.run}.peek() == '{';
    if (!is_json && request.profile) {
        return evidence_in(request.run, load_profile(*request.profile));
    }
    const auto text = net::text_of_file(request.run);
    if (!text) return tl::unexpected{text.error()};
    if (is_json) return evidence_of_statistics(request, *text);
    return base::fail(fmt::format("--profile is required: {} is neither what --stats has written "
                                  "nor a folder with a profile.toml",
                                  request.run));
}

base::Result<int> verify_run(const Request& request)
{
    const auto evidence = evidence_of(request);
    if (!evidence) return tl::unexpected{evidence.error()};
    const Profile& profile = evidence->profile;
    if (!profile.timeline.empty()) {
        return base::fail("the profile changes during the run: only what holds from the first "
                          "datagram to the last can be verified");
    }
    const Claim claim{.path = profile.path,
                      .seed = request.seed ? request.seed : profile.seed,
                      .spacing = request.spacing};
    const auto verification = verify(claim, evidence->fates.up, evidence->fates.down);
    fmt::print("{}", request.json ? json_of(verification) : to_text(verification));
    return verification.failed() ? net::exit_failed : 0;
}

} // namespace

int verify_program(std::span<char*> words)
{
    return net::run_program("hapnet-emulator", parse(words), verify_run);
}

} // namespace hapnet::emulator

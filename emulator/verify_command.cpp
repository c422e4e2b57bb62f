// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/core/fates/fates.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"
#include "emulator/fates_file.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/tools/verify/verify.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <fstream>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

nlohmann::json json_of(const std::vector<tools::TestResult>& results)
{
    auto list = nlohmann::json::array();
    for (const tools::TestResult& result : results) {
        list.push_back({{"test", result.name},
                        {"outcome", to_text(result.outcome)},
                        {"statistic", result.statistic},
                        {"p_value", result.p_value ? nlohmann::json(*result.p_value) : nullptr},
                        {"says", result.sentence}});
    }
    return list;
}

std::string json_of(const tools::Verification& verification)
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

base::Result<Evidence> evidence_in(const std::string& fates_path, base::Result<Profile> profile,
                                   const std::optional<std::string>& link)
{
    auto fates = read_fates(fates_path);
    if (!fates) return tl::unexpected{fates.error()};
    if (!profile) return tl::unexpected{profile.error()};
    const auto path = link.value_or("");
    const auto own = fates->find(path);
    if (own != fates->end()) return Evidence{std::move(own->second), profile_of(*profile, path)};
    std::vector<std::string_view> names;
    for (const auto& [name, of_path] : *fates) names.push_back(name);
    if (names.size() == 1 && names.front().empty()) {
        return base::fail(fmt::format("{} has fates of one path: leave out --link", fates_path));
    }
    return base::fail(fmt::format("{} has fates of several paths: name one with --link: {}",
                                  fates_path, fmt::join(names, ", ")));
}

/// Whether the fates are those of all datagrams that the statistics count. Rows that are missing at
/// the end of the table leave no gap in it.
base::Result<Evidence> all_there(Evidence evidence, const nlohmann::json& all,
                                 const std::optional<std::string>& link)
{
    const auto links = all.value("links", nlohmann::json::object());
    if (link && !links.contains(*link)) return evidence; // a client, which may be forgotten
    const nlohmann::json& statistics = link ? links[*link] : all;
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
base::Result<Evidence> evidence_of_statistics(const VerifyOptions& request, const std::string& text)
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
    const auto beside = path_beside(std::filesystem::path{fates}.filename().string(), path);
    const auto open = [&](const std::string& name) {
        return net::text_of_file(path_beside(name, path));
    };
    const auto profile = request.profile ? load_profile(*request.profile)
                                         : parse_profile(text_at("profile"), path, open);
    auto evidence =
        evidence_in(std::filesystem::exists(fates) ? fates : beside, profile, request.link);
    if (!evidence) return evidence;
    return all_there(*std::move(evidence), json, request.link);
}

base::Result<Evidence> evidence_of(const VerifyOptions& request)
{
    if (std::filesystem::is_directory(request.run)) {
        const auto inside = [&](const char* name) {
            return (std::filesystem::path{request.run} / name).string();
        };
        return evidence_in(inside("fates.csv"),
                           load_profile(request.profile.value_or(inside("profile.toml"))),
                           request.link);
    }
    // Fates may be larger than what text_of_file() takes.
    const bool is_json = std::ifstream{request.run}.peek() == '{';
    if (!is_json && request.profile) {
        return evidence_in(request.run, load_profile(*request.profile), request.link);
    }
    const auto text = net::text_of_file(request.run);
    if (!text) return tl::unexpected{text.error()};
    if (is_json) return evidence_of_statistics(request, *text);
    return base::fail(fmt::format("--profile is required: {} is neither what --stats has written "
                                  "nor a folder with a profile.toml",
                                  request.run));
}

} // namespace

base::Result<int> run(const VerifyOptions& request)
{
    const auto evidence = evidence_of(request);
    if (!evidence) return tl::unexpected{evidence.error()};
    const Profile& profile = evidence->profile;
    if (!profile.timeline.empty()) {
        return base::fail("the profile changes during the run: only what holds from the first "
                          "datagram to the last can be verified");
    }
    const tools::Claim claim{.path = profile.path,
                             .seed = request.seed ? request.seed : profile.seed,
                             .spacing = request.spacing,
                             .name = request.link.value_or("")};
    const auto verification = verify(claim, evidence->fates.up, evidence->fates.down);
    fmt::print("{}", request.as_json ? json_of(verification) : to_text(verification));
    return verification.failed() ? net::exit_failed : 0;
}

} // namespace hapnet::emulator

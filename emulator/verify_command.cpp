// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/core/fates/fates.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/regimes.hpp"
#include "emulator/profile_file.hpp"
#include "emulator/run_files.hpp"
#include "emulator/tools/verify/verify.hpp"
#include "proto/base/fields_json.hpp"
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

/// The fates of a run, and the profile that they should follow.
struct Evidence {
    Fates fates;
    Profile profile;
};

base::Result<Profile> profile_asked_for(const VerifyOptions& request)
{
    return load_profile(*request.profile, {.any = true}, "--profile");
}

base::Result<Evidence> evidence_in(const std::string& fates_path, base::Result<Profile> profile,
                                   const std::optional<std::string>& link)
{
    auto fates = fates_of_path(fates_path, link);
    if (!fates) return tl::unexpected{fates.error()};
    if (!profile) return tl::unexpected{profile.error()};
    auto own = profile_of(*profile, link.value_or(""));
    const auto names = names_of_regimes(own.path);
    auto counted = with_regimes(*std::move(fates), names[0], names[1]);
    if (!counted) return base::fail(fmt::format("{}: {}", fates_path, counted.error().message));
    return Evidence{*std::move(counted), std::move(own)};
}

/// Returns the evidence from the file of --stats, which contains the profile and names the fates.
base::Result<Evidence> evidence_of_statistics(const VerifyOptions& request, const std::string& text)
{
    const std::string& path = request.run;
    const auto statistics = statistics_in(text, path);
    if (!statistics) return tl::unexpected{statistics.error()};
    auto profile = request.profile ? profile_asked_for(request) : profile_of_run(*statistics, path);
    if (!profile) return tl::unexpected{profile.error()};
    if (const auto fine = ensure_testable(*statistics, *profile, path); !fine) {
        return tl::unexpected{fine.error()};
    }
    const auto fates = fates_path_of(*statistics, path);
    if (!fates) return tl::unexpected{fates.error()};
    auto evidence = evidence_in(*fates, std::move(profile), request.link);
    if (!evidence) return evidence;
    const auto own = of_path(*statistics, request.link);
    if (own.is_null()) return evidence; // fates of a client that was forgotten
    if (const auto fine = ensure_whole(evidence->fates, own); !fine) {
        return tl::unexpected{fine.error()};
    }
    return evidence;
}

base::Result<Evidence> evidence_of(const VerifyOptions& request)
{
    if (std::filesystem::is_directory(request.run)) {
        const auto inside = [&](const char* name) {
            return (std::filesystem::path{request.run} / name).string();
        };
        return evidence_in(inside("fates.csv"),
                           request.profile ? profile_asked_for(request)
                                           : load_profile(inside("profile.toml")),
                           request.link);
    }
    // Files of fates may be larger than text_of_file() accepts.
    const bool is_json = std::ifstream{request.run}.peek() == '{';
    if (!is_json && request.profile) {
        return evidence_in(request.run, profile_asked_for(request), request.link);
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
    const auto evidence = with_statistics(request.run, [&] { return evidence_of(request); });
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
    fmt::print("{}", request.as_json ? base::json_of(verification).dump(2) + "\n"
                                     : to_text(verification));
    return verification.failed() ? net::exit_failed : 0;
}

} // namespace hapnet::emulator

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/commands.hpp"
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/regimes.hpp"
#include "emulator/run_files.hpp"
#include "emulator/tools/run_page/run_page.hpp"
#include "proto/disk/result_file.hpp"
#include "proto/net/program.hpp"
#include "proto/net/text_file.hpp"

#include <filesystem>
#include <nlohmann/json.hpp>
#include <optional>
#include <spdlog/fmt/fmt.h>
#include <string>
#include <utility>

namespace hapnet::emulator {

namespace {

std::string file_name_of(const std::string& path)
{
    return std::filesystem::path{path}.filename().string();
}

/// Reads the fates, and tests them as far as possible.
base::Result<void> add_fates(tools::RunRecord& run, const ReportOptions& options)
{
    const auto named = fates_path_of(run.statistics, options.run);
    if (!named && !options.fates) {
        run.why_unverified = named.error().message;
        return {};
    }
    auto fates = fates_of_path(options.fates ? *options.fates : *named, options.link);
    if (!fates) {
        return base::fail(
            fmt::format("{}{}", options.fates ? "--fates: " : "", fates.error().message));
    }
    const auto names = names_of_regimes(profile_of(run.profile, run.link).path);
    auto counted = with_regimes(*std::move(fates), names[0], names[1]);
    if (!counted) {
        run.why_unverified = counted.error().message;
        return {};
    }
    run.fates = *std::move(counted);
    run.fates_file = file_name_of(options.fates ? *options.fates : *named);
    auto fine = ensure_whole(*run.fates, run.statistics);
    if (!fine) return fine;
    fine = ensure_testable(run.statistics, run.profile, options.run);
    if (!fine) {
        run.why_unverified = fine.error().message;
        return {};
    }
    run.verification = tools::verify({.path = profile_of(run.profile, run.link).path,
                                      .seed = run.profile.seed,
                                      .name = run.link},
                                     run.fates->up, run.fates->down);
    return {};
}

base::Result<int> write_page(const ReportOptions& options)
{
    const auto text = net::text_of_file(options.run);
    if (!text) return tl::unexpected{text.error()};
    auto statistics = statistics_in(*text, options.run);
    if (!statistics) return tl::unexpected{statistics.error()};
    auto profile = profile_of_run(*statistics, options.run);
    if (!profile) return tl::unexpected{profile.error()};
    auto own = of_path(*statistics, options.link);
    if (own.is_null()) {
        return base::fail(
            fmt::format("{} has no path '{}': 'links', 'clients' and 'flows' in it name "
                        "those that it has",
                        options.run, options.link.value_or("")));
    }
    tools::RunRecord run{std::move(own),
                         *std::move(profile),
                         {},
                         {},
                         {},
                         options.link.value_or(""),
                         file_name_of(options.run),
                         {}};
    if (const auto fine = add_fates(run, options); !fine) return tl::unexpected{fine.error()};
    const std::string page = run_page(run);
    if (options.out == "-") {
        fmt::print("{}", page);
        return 0;
    }
    disk::ResultFile{options.out, "--out"}.commit(page);
    net::say("hapnet-emulator", fmt::format("wrote {}", options.out));
    return 0;
}

} // namespace

base::Result<int> run(const ReportOptions& options)
{
    return with_statistics(options.run, [&] { return write_page(options); });
}

} // namespace hapnet::emulator

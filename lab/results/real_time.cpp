// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/results/real_time.hpp"

#include "device/governor/limits.hpp"
#include "emulator/core/profile/text.hpp"
#include "lab/metrics/metrics.hpp"
#include "peer/core/peer.hpp"
#include "peer/core/sync/text.hpp"
#include "proto/base/fields_json.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <memory>
#include <spdlog/fmt/fmt.h>
#include <string_view>
#include <utility>

namespace hapnet::lab::results {

namespace {

using Json = nlohmann::ordered_json;

constexpr double agreement_percent = 5.0; // largest difference in mean or std that agrees

/// The values that a program wrote down. Remembers the missing ones.
class Written {
public:
    Written(const Json& json, std::string_view program) : json_{json}, program_{program} {}

    template <typename Value>
    Value at(const std::string& pointer)
    {
        const Json::json_pointer where{pointer};
        Value value{};
        const bool is_said =
            json_.contains(where) && base::read_json(nlohmann::json(json_.at(where)), value);
        if (!is_said && !missing_) missing_ = fmt::format("{} does not say {}", program_, pointer);
        return value;
    }
    [[nodiscard]] const std::optional<std::string>& missing() const { return missing_; }

private:
    const Json& json_;
    std::string_view program_;
    std::optional<std::string> missing_;
};

/// Unpacks results and keeps the first error.
class Parts {
public:
    template <typename Value>
    Value take(base::Result<Value> part)
    {
        if (part) return *std::move(part);
        if (!error_) error_ = part.error().message;
        return {};
    }
    [[nodiscard]] const std::optional<std::string>& error() const { return error_; }

private:
    std::optional<std::string> error_;
};

/// Reads a spread in the form that `analyse` writes.
std::optional<metrics::Spread> spread_in(const Json& json)
{
    Written written{json, "the analysis"};
    const metrics::Spread spread{written.at<double>("/mean"), written.at<double>("/min"),
                                 written.at<double>("/max"), written.at<double>("/std")};
    if (written.missing()) return std::nullopt;
    return spread;
}

std::optional<metrics::Spread> in_mm(const std::optional<metrics::Spread>& metres)
{
    if (!metres) return std::nullopt;
    return metrics::Spread{1e3 * metres->mean, 1e3 * metres->min, 1e3 * metres->max,
                           1e3 * metres->std};
}

std::vector<std::string> objections_to(const RealTimeSession& session)
{
    auto objections = session.files.invalid_because();
    for (std::string& stall : stalls_of(session)) objections.push_back(std::move(stall));
    if (!session.files.analysis.value("discrepancy_x_mm", Json{}).is_object()) {
        objections.emplace_back("the two were never in session together");
    }
    return objections;
}

/// Returns the algorithm and the simulated person with which a peer played, according to its
/// report.
base::Result<virtual_time::PlayerSetting> player_of(const Json& report, Parts& parts)
{
    Written peer{report, "hapnet-peer"};
    const auto algorithm = peer.at<std::string>("/algorithm_toml");
    const auto person = peer.at<std::string>("/operator_toml");
    const auto grip_damping = peer.at<double>("/grip_damping_ns_per_m");
    if (peer.missing()) return base::fail(*peer.missing());
    if (grip_damping != peer::Settings{}.grip_damping_ns_per_m)
        return base::fail("virtual time supports only the default grip damping");
    virtual_time::PlayerSetting player;
    player.algorithm = parts.take(peer::parse_algorithm(algorithm, "the peer's algorithm"));
    player.person = parts.take(device::parse_operator(person, "the peer's operator"));
    return player;
}

std::string_view verdict_on(const RealTimeResult& result)
{
    if (!result.valid()) return "NOT VALID, excluded";
    const auto difference = result.difference_percent();
    if (!difference) return "nothing to compare";
    return std::abs(*difference) <= agreement_percent ? "agrees" : "DIFFERS";
}

} // namespace

KeptTime kept_time(std::span<const base::Duration> ticks)
{
    constexpr base::Duration tick{std::chrono::milliseconds{1}};
    KeptTime kept;
    for (std::size_t i = 1; i < ticks.size(); ++i) {
        const base::Duration gap = ticks[i] - ticks[i - 1];
        kept.longest_gap = std::max(kept.longest_gap, gap);
        const auto periods = (gap + tick / 2) / tick;
        if (periods > 1) kept.missed += static_cast<std::uint64_t>(periods - 1);
    }
    return kept;
}

std::vector<std::string> stalls_of(const RealTimeSession& session)
{
    constexpr base::Duration gap_max = device::GovernorLimits{}.stall_max;
    std::vector<std::string> stalls;
    for (std::size_t i = 0; i < session.ticks.size(); ++i) {
        const base::Duration gap = kept_time(session.ticks[i]).longest_gap;
        if (gap <= gap_max) continue;
        stalls.push_back(fmt::format("peer {}: the loop stood still for {:.1f} ms; after {:.0f} ms "
                                     "the governor takes the force away",
                                     i + 1, 1e3 * base::to_seconds(gap),
                                     1e3 * base::to_seconds(gap_max)));
    }
    return stalls;
}

base::Result<virtual_time::Setting> twin_of(const RealTimeSession& session,
                                            const base::OpenFile& open)
{
    Written peer{session.files.peer, "hapnet-peer"};
    Written emulator{session.files.emulator, "hapnet-emulator"};
    const auto task = peer.at<std::string>("/task");
    const auto scene = peer.at<std::string>("/scene");
    const auto profile = emulator.at<std::string>("/profile");
    virtual_time::Setting setting;
    const Json others = session.files.peer.value("others", Json::array());
    setting.players.resize(std::max<std::size_t>(others.size(), 1) + 1);
    setting.energy_limit = true; // as in the daemons
    setting.length = base::from_seconds(peer.at<double>("/duration_s"));
    setting.seed = base::Seed{emulator.at<std::uint64_t>("/seed")};
    setting.players[0].seed = base::Seed{peer.at<std::uint64_t>("/session/seed")};
    for (const Written* written : {&peer, &emulator}) {
        if (written->missing()) return base::fail(*written->missing());
    }

    Parts parts;
    setting.task = parts.take(device::task_named(task));
    setting.scene = parts.take(scene::load_scene(scene, open));
    setting.profile = parts.take(emulator::parse_profile(profile, "the emulator's profile", open));
    for (std::size_t i = 0; i < setting.players.size(); ++i) {
        const bool is_said = i > 0 && i <= session.files.others.size();
        auto player = player_of(is_said ? session.files.others[i - 1] : session.files.peer, parts);
        if (!player) return tl::unexpected{player.error()};
        player->seed = setting.players[i].seed;
        setting.players[i] = *std::move(player);
    }
    if (parts.error()) return base::fail(*parts.error());
    if (session.ticks.size() == setting.players.size()) {
        for (std::size_t i = 0; i < session.ticks.size(); ++i) {
            setting.players[i].ticks =
                std::make_shared<const std::vector<base::Duration>>(session.ticks[i]);
        }
    }
    if (auto valid = validate(setting); !valid) return tl::unexpected{std::move(valid).error()};
    return setting;
}

std::optional<double> RealTimeResult::difference_percent() const
{
    if (!valid() || !real_mm || !virtual_mm) return std::nullopt;
    if (virtual_mm->mean == 0.0 || virtual_mm->std == 0.0) return std::nullopt;
    const double of_mean = 100.0 * (real_mm->mean - virtual_mm->mean) / virtual_mm->mean;
    const double of_std = 100.0 * (real_mm->std - virtual_mm->std) / virtual_mm->std;
    return std::abs(of_mean) >= std::abs(of_std) ? of_mean : of_std;
}

RealTimeResult result_of(const RealTimeSession& session, const virtual_time::Trace& twin)
{
    RealTimeResult result;
    result.algorithm = session.files.peer.value("algorithm", "?");
    result.where = session.where;
    result.real_mm = spread_in(session.files.analysis.value("discrepancy_x_mm", Json{}));
    result.virtual_mm = in_mm(metrics::metrics_of(twin).discrepancy_m);
    result.invalid_because = objections_to(session);
    return result;
}

Table real_time_rows(std::span<const RealTimeResult> results)
{
    Table table{"real_time",
                columns_in("algorithm,where,mean_mm:4,std_mm:4,max_mm:4,virtual_mean_mm:4,"
                           "virtual_std_mm:4,virtual_max_mm:4,difference_percent:2,valid,"
                           "invalid_because")};
    const auto part = [](const std::optional<metrics::Spread>& spread,
                         double metrics::Spread::*value) {
        return spread ? std::optional{(*spread).*value} : std::nullopt;
    };
    for (const RealTimeResult& one : results) {
        using metrics::Spread;
        table.add(one.algorithm, one.where, part(one.real_mm, &Spread::mean),
                  part(one.real_mm, &Spread::std), part(one.real_mm, &Spread::max),
                  part(one.virtual_mm, &Spread::mean), part(one.virtual_mm, &Spread::std),
                  part(one.virtual_mm, &Spread::max), one.difference_percent(), one.valid(),
                  fmt::format("{}", fmt::join(one.invalid_because, "; ")));
    }
    return table;
}

std::string real_time_table(std::span<const RealTimeResult> results)
{
    constexpr auto row = "{:<16}{:<12}{:>9}{:>9}{:>9}   {}\n";
    std::string table = fmt::format(row, "|x_L - x_R|, mm", "where", "mean", "std", "max",
                                    "real time against virtual time");
    const auto line = [&](const RealTimeResult& result, std::string_view where,
                          const std::optional<metrics::Spread>& spread, std::string_view note) {
        const auto cell = [&](double metrics::Spread::*part) {
            return spread ? fmt::format("{:.2f}", (*spread).*part) : std::string{"-"};
        };
        table += fmt::format(row, result.algorithm, where, cell(&metrics::Spread::mean),
                             cell(&metrics::Spread::std), cell(&metrics::Spread::max), note);
    };
    for (const RealTimeResult& result : results) {
        line(result, "virtual", result.virtual_mm, "");
        const auto percent = result.difference_percent();
        line(result, result.where, result.real_mm,
             !percent ? std::string{verdict_on(result)}
                      : fmt::format("{:.2f} % off at most: {}", *percent, verdict_on(result)));
        for (const auto& reason : result.invalid_because) table += "  " + reason + '\n';
    }
    return table;
}

Json real_time_manifest(std::span<const RealTimeResult> results, const Circumstances& circumstances)
{
    Json sessions = Json::array();
    for (const RealTimeResult& result : results) {
        sessions.push_back({{"algorithm", result.algorithm},
                            {"where", result.where},
                            {"valid", result.valid()},
                            {"invalid_because", result.invalid_because}});
    }
    const auto is_valid = [](const RealTimeResult& result) { return result.valid(); };
    Json manifest = manifest_head(circumstances);
    manifest["valid"] = std::ranges::all_of(results, is_valid);
    manifest["sessions"] = sessions;
    return manifest;
}

} // namespace hapnet::lab::results

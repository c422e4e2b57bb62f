// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "device/fault.hpp"
#include "device/governor.hpp"
#include "device/governor/limits_text.hpp"
#include "device/simulated/operator.hpp"
#include "device/simulated/task_options.hpp"
#include "emulator/control/frame_report.hpp"
#include "emulator/control/run_statistics.hpp"
#include "emulator/core/conditions.hpp"
#include "emulator/core/flow/flow.hpp"
#include "emulator/tools/learn/learn.hpp"
#include "emulator/tools/prediction_report.hpp"
#include "emulator/tools/probe_statistics.hpp"
#include "emulator/tools/verify/verify.hpp"
#include "lab/experiment/fields.hpp"
#include "lab/hands/imitation.hpp"
#include "lab/hands/manifest.hpp"
#include "lab/metrics/criteria.hpp"
#include "lab/results/requirements.hpp"
#include "peer/core/sync/algorithm.hpp"
#include "proto/base/fields.hpp"
#include "proto/output/key_table.hpp"
#include "proto/record/field_types.hpp"
#include "proto/record/fields.hpp"
#include "scene/text/fields.hpp"
#include "tests/tidy/source_tree.hpp"

#include <algorithm>
#include <cstdlib>
#include <fstream>
#include <gtest/gtest.h>
#include <set>

// The tables of keys in the pages are those of the structs (proto/base/fields.hpp). With
// HAPNET_WRITE_KEY_TABLES=1 this test writes them into the pages instead of comparing them.

namespace hapnet::tidy {
namespace {

using base::KeyRow;
using Rows = std::vector<KeyRow>;

/// The text of a page between "<!-- keys: NAME -->" and "<!-- end keys -->".
struct KeyTable {
    std::string name;
    std::string text;
};

Rows operator+(Rows rows, const Rows& more)
{
    rows.insert(rows.end(), more.begin(), more.end());
    return rows;
}

/// The keys of an algorithm without the common ones.
template <typename Options>
Rows own_rows()
{
    Rows rows = base::key_rows<Options>();
    const Rows common = base::key_rows<peer::BaseOptions>();
    std::erase_if(rows, [&](const KeyRow& row) {
        return std::any_of(common.begin(), common.end(),
                           [&](const KeyRow& other) { return other.key == row.key; });
    });
    return rows;
}

/// The keys that stand in a table of their own.
template <typename Struct>
std::string prefix()
{
    return lab::experiment::has_own_table<Struct> ? fmt::format("{}.", base::described_name<Struct>)
                                                  : "";
}

/// The keys of several structs in one table, whose first column names the struct.
template <typename... Structs>
std::string grouped(std::string_view heading)
{
    std::string text =
        fmt::format("| {} | key | value | default | meaning |\n|---|---|---|---|---|\n", heading);
    const auto add = [&](std::string_view name, const std::string& table) {
        std::string_view rest{table};
        for (int head = 0; head < 2; ++head) rest.remove_prefix(rest.find('\n') + 1);
        for (; !rest.empty(); rest.remove_prefix(rest.find('\n') + 1)) {
            text += fmt::format("| `{}` {}", name, rest.substr(0, rest.find('\n') + 1));
        }
    };
    (add(base::described_name<Structs>, base::markdown(base::key_rows<Structs>(prefix<Structs>()))),
     ...);
    return text;
}

template <typename... Structs>
std::string grouped(std::string_view heading, const std::variant<Structs...>& /*of these*/)
{
    return grouped<Structs...>(heading);
}

template <base::Named Enum>
std::string numbered()
{
    std::string text;
    for (std::size_t i = 0; i < base::names_of_enum<Enum>.size(); ++i) {
        text += fmt::format("{}{} {}", i == 0 ? ": " : ", ", i, base::names_of_enum<Enum>[i]);
    }
    return text;
}

/// The bytes of a row of a record.
template <typename Row>
std::string byte_table()
{
    std::string text = "| offset | type | field | unit | meaning |\n|---|---|---|---|---|\n";
    std::size_t offset = sizeof(record::kind_code<Row>);
    base::for_each_field(
        [&](const auto& field, const auto& member) {
            using Value = std::remove_cvref_t<decltype(member)>;
            using Type = record::FieldType<Value>;
            std::string about{field.about};
            if constexpr (base::Named<Value>) about += numbered<Value>();
            if (field.key == "fault") about += numbered<device::Fault>();
            if (field.key == "governor") about += numbered<device::GovernorState>();
            text += fmt::format("| {} | {} | `{}` | {} | {} |\n", offset, Type::type, field.key,
                                Type::unit, about);
            offset += Type::bytes;
        },
        Row{});
    return text;
}

template <typename... Structs>
std::string rows_of()
{
    return base::markdown((base::key_rows<Structs>() + ...));
}

/// The tables of the programs' outputs.
std::vector<KeyTable> tables_of_outputs()
{
    return {
        {"emulator-run", output::key_table<emulator::RunStatistics>()},
        {"emulator-direction", output::key_table<emulator::DirectionReport>()},
        {"emulator-change", output::key_table<emulator::ChangeReport>()},
        {"emulator-stretch", output::key_table<emulator::StretchReport>()},
        {"emulator-lens", output::key_table<emulator::StreamShape>()},
        {"emulator-client", output::key_table<emulator::ClientReport>()},
        {"emulator-link", output::key_table<emulator::LinkReport>()},
        {"emulator-interface", output::key_table<emulator::InterfaceReport>()},
        {"emulator-check", output::key_table<emulator::CheckReport>()},
        {"predict", output::key_table<emulator::tools::PredictionReport>()},
        {"predict-direction", output::key_table<emulator::tools::DirectionForecast>()},
        {"learn", output::key_table<emulator::tools::LearnReport>()},
        {"learn-way", output::key_table<emulator::tools::WayLesson>()},
        {"learn-regime", output::key_table<emulator::tools::LearnedRegime>()},
        {"learn-likeness", output::key_table<emulator::tools::Likeness>()},
        {"verify", output::key_table<emulator::tools::Verification>()},
        {"verify-test", output::key_table<emulator::tools::TestResult>()},
        {"probe", output::key_table<emulator::tools::ProbeReport>()},
        {"emulator-frame", output::key_table<emulator::EmulatorFrame>()},
        {"emulator-frame-way", output::key_table<emulator::WayFrame>()},
        {"hands", output::key_table<lab::hands::Manifest>()},
        {"hands-trial", output::key_table<lab::hands::ImportedTrial>()},
        {"hands-hand", output::key_table<lab::hands::ImportedHand>()},
        {"fitted-hands", output::key_table<lab::hands::Imitation>()},
        {"fitted-subject", output::key_table<lab::hands::SubjectModels>()},
        {"fitted-model", output::key_table<lab::hands::MotionModel>()},
        {"fitted-figure", output::key_table<lab::hands::ComparedFigure>()},
        {"motion-figures", output::key_table<lab::hands::MotionFigures>()},
        {"requirements", output::key_table<lab::results::Requirement>()},
        {"network-classes", output::key_table<lab::results::NetworkClass>()},
    };
}

std::vector<KeyTable> tables_of_inputs()
{
    return {
        {"base", rows_of<peer::BaseOptions>()},
        {"dead-reckoning", base::markdown(own_rows<peer::DeadReckoningOptions>())},
        {"sep", base::markdown(own_rows<peer::EstimatorPredictorOptions>())},
        {"remote-proxy", rows_of<peer::RemoteProxyOptions>()},
        {"base-tdpa", base::markdown(own_rows<peer::BaseTdpaOptions>())},
        {"wave", rows_of<peer::WaveOptions>()},
        {"couple", rows_of<peer::CoupleOptions>()},
        {"lag", rows_of<peer::LagOptions>()},
        {"rollback", rows_of<peer::RollbackOptions>()},
        {"shared-object", rows_of<peer::SharedObjectOptions>()},
        {"governor", base::markdown(device::limit_keys())},
        {"operator", rows_of<device::Operator>()},
        {"task-options", rows_of<device::TaskOptions>()},
        {"delay-laws", grouped("law", emulator::Variation{}.law)},
        {"loss-laws", grouped("law", emulator::LossLaw{})},
        {"stages",
         grouped<emulator::Mtu, emulator::Rate, emulator::QueueControl, emulator::Corruption,
                 emulator::Duplication, emulator::Reordering>("stage")},
        {"rate-trace", rows_of<emulator::RateTraceLaw>()},
        {"flow", rows_of<emulator::Flow>()},
        {"regime", rows_of<emulator::Regime>()},
        {"scene", rows_of<scene::Description>()},
        {"hips", rows_of<scene::HandDescription>()},
        {"hand", rows_of<scene::Feel>()},
        {"field", rows_of<scene::FieldDescription>()},
        {"plane", rows_of<scene::PlaneDescription>()},
        {"body", rows_of<scene::BodyDescription, scene::text::Density>()},
        {"part", rows_of<scene::PartDescription>()},
        {"array", rows_of<scene::text::Array>()},
        {"experiment", base::markdown(base::key_rows<lab::experiment::Experiment>(
                           "", lab::experiment::usual_experiment()))},
        {"experiment-axis", rows_of<lab::experiment::Axis>()},
        {"experiment-kinds", grouped("kind", lab::experiment::Kind{})},
        {"criteria", rows_of<lab::metrics::Criteria>()},
        {"tick-row", byte_table<record::TickRow>()},
        {"message-row", byte_table<record::MessageRow>()},
        {"session-row", byte_table<record::SessionRow>()},
        {"body-row", byte_table<record::BodyRow>()},
    };
}

const std::vector<KeyTable>& tables()
{
    static const std::vector<KeyTable> all = [] {
        auto both = tables_of_inputs();
        const auto outputs = tables_of_outputs();
        both.insert(both.end(), outputs.begin(), outputs.end());
        return both;
    }();
    return all;
}

/// Described structs without a table of their own: parts of the above, and texts of programs.
const std::set<std::string>& without_table()
{
    static const std::set<std::string> names{
        "HandDynamics", "ProxyHandOptions", "Material", "Sway", "ByOrder", "UsableCriteria",
        "GoodCriteria", "HandImpedance", "TraceTiming", "InvoluntaryMotion", "Reflex", "Intent",
        "Search", "GovernorLimits", "EnergyLimits", "WrittenCorner", "WrittenTorques",
        "RangeOf<what", "SearchRanges", "Sensitivity", "LatinHypercube", "Match",
        // parts of the outputs above
        "Counters", "ProgramReport", "EndsReport", "FilesReport", "StreamReport", "TimesReport",
        "DelayReport", "Estimate", "CorrelationAt", "LossWhenSlow", "ReorderReport",
        "Configuration", "FirstDatagrams", "CourseReport", "RegimeReport", "LinkEnds", "FlowReport",
        "RealTimeReport", "DelaySpread", "LateSpread", "PathFrame", "Precision", "LossReport",
        "ProbeDelays", "ProbeWay", "ProbeSummary",
        // JSON, CSV and the settings in a record's header
        "BuildReport", "TickFrame", "PeerConfiguration", "SessionReport", "ClockReport",
        "AgeReport", "PathTimes", "InwardPath", "OtherReport", "MessagesReport", "ForceReport",
        "EnergyReport", "PeerStatistics", "TickReport", "Counters", "GovernorFigures",
        "FaultCounts", "GovernorCounters", "RigCounters", "EnergyFigures", "Association::Counts",
        "Status::Key", "RealTime", "Clock", "Loop", "LoopReport", "Path", "ForceDiscrepancy",
        "TouchShares", "BodyAgreement", "Agreement", "Analysis", "PairReport", "AnalysisReport",
        "Replayed", "FeatureReport", "TickBound", "CheaperTick", "MassRange", "HandsReport",
        "Explanation", "PlayedSession", "PlayReport", "PeerIntroduction", "Outcome",
        "CapabilitiesReport", "TestedDevice", "SelfTestReport", "OtherSession", "Frame",
        "HeardFrame", "BodyFrame", "SessionFrame", "Largest", "Range", "Examination", "Finding",
        "Spread", "ForceSteps", "Similarity", "BodyApart", "Metrics", "ConditionRow",
        "WrittenMount", "WrittenConfig"};
    return names;
}

/// Structs of the tables above, as their sources call them.
const std::set<std::string>& with_table()
{
    static const std::set<std::string> names{
        // that people write
        "BaseOptions", "DeadReckoningOptions", "EstimatorPredictorOptions", "RemoteProxyOptions",
        "BaseTdpaOptions", "WaveOptions", "CoupleOptions", "LagOptions", "RollbackOptions",
        "SharedObjectOptions", "WrittenLimits", "Operator", "OmniPlant", "TaskOptions", "Axis",
        "Mtu", "Rate", "Corruption", "Duplication", "Reordering", "RateTraceLaw", "Flow", "Regime",
        "QueueControl", "Description", "HandDescription", "Feel", "FieldDescription",
        "PlaneDescription", "BodyDescription", "PartDescription", "Density", "Array", "Criteria",
        "Experiment", "Table1", "Limits", "Trajectories", "ImpairmentGrid", "Calibration", "Claims",
        "TickRow", "BodyRow", "MessageRow", "SessionRow", "Manifest", "ImportedTrial",
        "ImportedHand", "Imitation", "SubjectModels", "MotionModel", "ComparedFigure",
        "MotionFigures",
        // that programs print
        "RunStatistics", "DirectionReport", "ChangeReport", "StreamShape", "StretchReport",
        "ClientReport", "LinkReport", "InterfaceReport", "CheckReport", "PredictionReport",
        "DirectionForecast", "LearnReport", "WayLesson", "LearnedRegime", "Likeness",
        "Verification", "TestResult", "ProbeReport", "EmulatorFrame", "WayFrame", "Requirement",
        "NetworkClass"};
    return names;
}

const std::vector<SourceFile>& tree()
{
    static const std::vector<SourceFile> files = read_tree(HAPNET_SOURCE_DIR);
    return files;
}

constexpr std::string_view mark = "<!-- keys: ";
constexpr std::string_view mark_end = " -->";
constexpr std::string_view end_mark = "<!-- end keys -->";

/// The name that a line marks; empty: none.
std::string marked(std::string_view line)
{
    if (!line.starts_with(mark) || !line.ends_with(mark_end)) return "";
    return std::string{line.substr(mark.size(), line.size() - mark.size() - mark_end.size())};
}

/// Returns the corrected page, and complains where it differs.
std::string corrected(const SourceFile& page, std::set<std::string>& found)
{
    std::string text;
    for (std::size_t i = 0; i < page.lines.size(); ++i) {
        text += page.lines[i] + '\n';
        const std::string name = marked(page.lines[i]);
        if (name.empty()) continue;
        EXPECT_TRUE(found.insert(name).second) << page.path << ": there are two tables " << name;
        const auto table = std::find_if(tables().begin(), tables().end(),
                                        [&](const KeyTable& one) { return one.name == name; });
        const auto end = std::find(page.lines.begin() + static_cast<std::ptrdiff_t>(i),
                                   page.lines.end(), end_mark);
        if (table == tables().end() || end == page.lines.end()) {
            ADD_FAILURE() << page.path << ':' << i + 1 << ": "
                          << (table == tables().end() ? "no struct is called " + name
                                                      : std::string{"no end of the table"});
            continue;
        }
        std::string between;
        for (++i; page.lines[i] != end_mark; ++i) between += page.lines[i] + '\n';
        const std::string expected = '\n' + table->text + '\n';
        const bool is_written = std::getenv("HAPNET_WRITE_KEY_TABLES") != nullptr;
        EXPECT_TRUE(between == expected || is_written)
            << page.path << ": the table '" << name << "' is not that of the struct. Run this test "
            << "with HAPNET_WRITE_KEY_TABLES=1 to write it:\n"
            << expected;
        text += expected + std::string{end_mark} + '\n';
    }
    return text;
}

TEST(KeyTables, OfThePagesAreThoseOfTheStructs)
{
    std::set<std::string> found;
    for (const SourceFile& page : tree()) {
        if (!page.path.ends_with(".md")) continue;
        const std::size_t before = found.size();
        const std::string text = corrected(page, found);
        if (found.size() == before || std::getenv("HAPNET_WRITE_KEY_TABLES") == nullptr) continue;
        std::ofstream{HAPNET_SOURCE_DIR "/" + page.path} << text;
    }
    for (const KeyTable& table : tables()) {
        EXPECT_TRUE(found.contains(table.name)) << "no page has a table " << table.name;
    }
}

TEST(KeyTables, LackNoStructThatPeopleWriteAndNoMeaning)
{
    constexpr std::string_view opening = "fields_of(base::Tag<";
    std::set<std::string> described;
    for (const SourceFile& file : tree()) {
        // Laws are those of their variants.
        const bool is_law = file.is_in("emulator/core/delay") || file.is_in("emulator/core/loss");
        if (!file.is_cpp() || file.is_in("tests") || file.is_in("proto/base") || is_law) continue;
        for (const std::string& line : file.lines) {
            if (line.starts_with("//") || line.find(opening) == std::string::npos) continue;
            const auto name = line.substr(line.find(opening) + opening.size());
            described.insert(name.substr(0, name.find(">")));
        }
    }
    for (const std::string& name : described) {
        EXPECT_TRUE(with_table().contains(name) || without_table().contains(name))
            << name << " has neither a table of its keys in the docs nor a reason to have none";
    }
    for (const auto* names : {&with_table(), &without_table()}) {
        for (const std::string& name : *names) EXPECT_TRUE(described.contains(name)) << name;
    }
    for (const KeyTable& table : tables()) {
        EXPECT_EQ(table.text.find("|  |\n"), std::string::npos)
            << table.name << " has a key without a meaning:\n"
            << table.text;
    }
}

} // namespace
} // namespace hapnet::tidy

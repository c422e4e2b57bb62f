// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// Sessions that a run keeps, reuses and finds, with any number of threads.
#include "lab/experiment/claims.hpp"
#include "lab/experiment/text.hpp"
#include "lab/results/found.hpp"
#include "lab/results/table_text.hpp"
#include "lab/runner/checksums.hpp"
#include "lab/runner/progress.hpp"
#include "lab/runner/result_tables.hpp"
#include "lab/runner/runner.hpp"
#include "tests/unit/lab/experiment/known_law.hpp"

#include <chrono>
#include <csignal>
#include <cstdio>
#include <filesystem>
#include <fstream>
#include <gtest/gtest.h>
#include <nlohmann/json.hpp>
#include <set>
#include <sstream>
#include <sys/resource.h>
#include <system_error>

namespace hapnet::lab::runner::runner_test {

namespace {

using namespace std::chrono_literals;

/// A file of sessions of its own for each test.
class SessionFile : public testing::Test {
protected:
    SessionFile()
        : path{(std::filesystem::temp_directory_path() /
                (std::string{"hapnet-sessions-"} +
                 testing::UnitTest::GetInstance()->current_test_info()->name()))
                   .string()}
    {
        std::filesystem::remove(path);
    }
    ~SessionFile() override { std::filesystem::remove(path); }

    [[nodiscard]] std::unique_ptr<SessionStore> open(const std::string& program = "this") const
    {
        return SessionStore::open(path, {"limits", "known"}, program).value();
    }

    [[nodiscard]] std::string text() const
    {
        std::ostringstream out;
        out << std::ifstream{path}.rdbuf();
        return out.str();
    }

    std::string path;
    net::StopSignal stop;
};

experiment::Experiment known_limits(const std::vector<std::string>& settings = {})
{
    return *experiment::parse_experiment(R"(
kind = "limits"
title = "known"
seeds = 3
tasks = ["T1", "T3"]
[limit.delay]
to = "200ms"
step = "50ms"
resolution = "5ms"
)",
                                         "test.toml", {false, settings});
}

base::Result<experiment::PlayedSession> play_known(const experiment::SessionSpec& spec,
                                                   const std::atomic<bool>&)
{
    return known_session(spec);
}

base::Result<std::optional<std::vector<experiment::JobResult>>>
run_whole(const experiment::Experiment& experiment, const Runner& runner, net::StopSignal& stop)
{
    std::vector<Assignment> jobs;
    for (auto& job : make_jobs(experiment)) jobs.push_back({&experiment, std::move(job)});
    return run_all(jobs, experiment::known_criteria(), runner, stop);
}

Runner runner_of(SessionStore& store, unsigned jobs)
{
    return {store, play_known, jobs, [](const RunProgress&) {}};
}

std::string limits_of(const experiment::Experiment& experiment,
                      const std::vector<experiment::JobResult>& findings)
{
    return csv_text(
        results::find_results(experiment, experiment::known_criteria(), findings)->tables.front());
}

} // namespace

TEST_F(SessionFile, GivesTheSameResultsForAnyNumberOfJobsAndPlaysNoSessionTwice)
{
    const auto experiment = known_limits();
    std::string one_thread;
    SessionStore::Counts counts;
    for (const unsigned jobs : {1U, 2U, 5U}) {
        std::filesystem::remove(path);
        const auto store = open();
        const auto findings = run_whole(experiment, runner_of(*store, jobs), stop);
        ASSERT_TRUE(findings && *findings);
        const auto limits = limits_of(experiment, **findings);
        if (jobs == 1) {
            one_thread = limits;
            counts = store->counts();
        }
        EXPECT_EQ(limits, one_thread);
        EXPECT_EQ(store->counts().played, counts.played);
        EXPECT_EQ(store->counts().reused, 0U);
    }
    EXPECT_GT(counts.played, 50U);
}

TEST_F(SessionFile, ReusesWhatAnEarlierRunHasPlayedAlsoInALargerExperiment)
{
    const auto run = [&](const experiment::Experiment& experiment) {
        const auto store = open();
        const auto findings = run_whole(experiment, runner_of(*store, 2), stop);
        EXPECT_TRUE(findings && *findings);
        return store->counts();
    };
    const auto first = run(known_limits());
    const auto again = run(known_limits());
    EXPECT_EQ(again.played, 0U);
    EXPECT_EQ(again.reused, first.played);
    const auto larger = run(known_limits({"seeds=4"}));
    EXPECT_GT(larger.played, 0U);
    EXPECT_EQ(larger.reused, first.played);
}

TEST_F(SessionFile, DoesNotReuseTheSessionsOfAnotherProgram)
{
    std::ignore = run_whole(known_limits(), runner_of(*open(), 1), stop);
    const auto store = open("that");
    std::ignore = run_whole(known_limits(), runner_of(*store, 1), stop);
    EXPECT_EQ(store->counts().reused, 0U);
}

TEST_F(SessionFile, SaysOfEachSessionWhatTheExperimentCallsItsAlgorithmAndItsNetwork)
{
    const std::vector<std::string> settings{"algorithms=[\"base\", \"lead10\"]",
                                            "algorithm.lead10.algorithm=dead-reckoning"};
    std::ignore = run_whole(known_limits(settings), runner_of(*open(), 1), stop);
    std::istringstream lines{text()};
    std::set<std::string> algorithms, networks;
    std::string line;
    std::getline(lines, line); // the header
    while (std::getline(lines, line)) {
        const auto session = nlohmann::json::parse(line);
        algorithms.insert(session["algorithm"].get<std::string>());
        networks.insert(session["network"].get<std::string>());
    }
    EXPECT_EQ(algorithms, (std::set<std::string>{"base", "lead10"}));
    EXPECT_GT(networks.size(), 5U);
    EXPECT_TRUE(networks.contains("")) << "the perfect one";
}

TEST_F(SessionFile, LosesOnlyTheLineThatWasCutOff)
{
    std::ignore = run_whole(known_limits(), runner_of(*open(), 1), stop);
    const auto whole = text();
    const auto lines = static_cast<std::size_t>(std::count(whole.begin(), whole.end(), '\n'));
    std::filesystem::resize_file(path, whole.size() - 20);
    for (const std::size_t played : {std::size_t{1}, std::size_t{0}}) {
        const auto store = open();
        EXPECT_EQ(store->damaged_lines(), 1U);
        const auto findings = run_whole(known_limits(), runner_of(*store, 1), stop);
        ASSERT_TRUE(findings && *findings);
        EXPECT_EQ(store->counts().played, played);
        EXPECT_EQ(store->counts().reused, lines - 1 - played); // the first is a header
    }
}

TEST_F(SessionFile, RefusesAnotherExperimentASecondRunAndAFileOfSomethingElse)
{
    const auto refusal = [&](const FolderIdentity& identity) {
        const auto store = SessionStore::open(path, identity, "this");
        return store ? std::string{} : store.error().message;
    };
    {
        const auto store = open();
        EXPECT_NE(refusal({"limits", "known"}).find("in use by another run"), std::string::npos);
    }
    EXPECT_EQ(refusal({"limits", "known"}), "");
    EXPECT_NE(refusal({"limits", "other"}).find("another experiment, 'known'"), std::string::npos);
    EXPECT_NE(refusal({"plane", "known"}).find("choose another --out"), std::string::npos);
    std::ofstream{path} << "a,b\n";
    EXPECT_NE(refusal({"limits", "known"}).find("something else"), std::string::npos);
}

TEST_F(SessionFile, KeepsWhatWasPlayedBeforeASessionFailed)
{
    const auto store = open();
    Runner runner = runner_of(*store, 1);
    std::size_t played = 0;
    runner.play = [&](const experiment::SessionSpec& spec,
                      const std::atomic<bool>&) -> base::Result<experiment::PlayedSession> {
        if (++played > 5) return base::fail("the scene cannot be shared");
        return known_session(spec);
    };
    const auto findings = run_whole(known_limits(), runner, stop);
    ASSERT_FALSE(findings);
    EXPECT_EQ(findings.error().message, "the scene cannot be shared");
    EXPECT_EQ(store->counts().played, 5U);
}

TEST_F(SessionFile, PassesOnWhatAThreadHasThrown)
{
    const auto store = open();
    Runner runner = runner_of(*store, 2);
    runner.play = [](const experiment::SessionSpec&,
                     const std::atomic<bool>&) -> base::Result<experiment::PlayedSession> {
        throw std::runtime_error{"disk full"};
    };
    EXPECT_THROW(std::ignore = run_whole(known_limits(), runner, stop), std::runtime_error);
}

TEST_F(SessionFile, ReadsTheSessionsOfSeveralFilesAndKeepsNoOther)
{
    const auto other = path + "-other";
    std::filesystem::remove(other);
    std::ignore = run_whole(known_limits({"tasks=T1"}), runner_of(*open(), 1), stop);
    {
        const auto store = SessionStore::open(other, {"limits", "known"}, "this").value();
        std::ignore = run_whole(known_limits({"tasks=T3"}), runner_of(*store, 1), stop);
    }
    const auto before = text();
    const std::vector files{path, other};
    const auto both = SessionStore::open_all(files, {"limits", "known"}, "this").value();
    ASSERT_TRUE(run_whole(known_limits(), runner_of(*both, 2), stop));
    EXPECT_EQ(both->counts().played, 0U);
    const auto one = SessionStore::open_all({&path, 1}, {"limits", "known"}, "this").value();
    ASSERT_TRUE(run_whole(known_limits(), runner_of(*one, 2), stop));
    EXPECT_EQ(text(), before);
    EXPECT_FALSE(SessionStore::open_all(files, {"limits", "other"}, "this"));
    std::filesystem::remove(other);
}

TEST_F(SessionFile, KeepsHowFarCopiesAreApartAfterSilence)
{
    const auto none = [](const std::string& name) { return base::fail(name); };
    const auto claims =
        experiment::load_experiment("beat", none, {.quick = false, .settings = {"seeds=2"}})
            .value();
    constexpr double apart_m = 1.0 / 3e4; // needs all digits
    const auto ends_of_silence = [&](SessionStore& store) {
        Runner runner = runner_of(store, 2);
        runner.play = [&](const experiment::SessionSpec& spec, const std::atomic<bool>&) {
            auto played = known_session(spec);
            if (spec.silence) played.apart_m = apart_m;
            return base::Result<experiment::PlayedSession>{played};
        };
        std::vector<double> ends;
        const auto findings = run_whole(claims, runner, stop);
        EXPECT_TRUE(findings) << findings.error().message;
        if (!findings) return ends;
        for (const auto& one : findings->value()) {
            const auto* const silence = std::get_if<experiment::SilenceResult>(&one);
            if (silence != nullptr) ends.push_back(silence->apart_m);
        }
        return ends;
    };
    EXPECT_EQ(ends_of_silence(*open()), (std::vector{apart_m, apart_m}));
    {
        const auto again = open();
        EXPECT_EQ(ends_of_silence(*again), (std::vector{apart_m, apart_m}));
        EXPECT_EQ(again->counts().played, 0U);
    }
    std::ofstream{path, std::ios::app} << with_sum(R"({"key":"k","metrics":{},"apart_m":"far"})")
                                       << '\n';
    EXPECT_EQ(open()->damaged_lines(), 1U);
}

TEST_F(SessionFile, PlaysASessionAgainWhoseLineWasChangedByADigit)
{
    std::ignore = run_whole(known_limits(), runner_of(*open(), 1), stop);
    const auto whole = text();
    const auto limits = [&] {
        const auto store = open();
        const auto findings = run_whole(known_limits(), runner_of(*store, 1), stop);
        EXPECT_EQ(store->counts().played, 1U);
        return limits_of(known_limits(), findings->value());
    };
    std::string changed = whole;
    const auto at = changed.find("\"scored_s\":", changed.size() / 2) + 11;
    changed[at] = changed[at] == '9' ? '8' : static_cast<char>(changed[at] + 1);
    ASSERT_NE(changed, whole);
    std::ofstream{path} << changed;
    const auto line =
        1 + std::count(changed.begin(), changed.begin() + static_cast<std::ptrdiff_t>(at), '\n');
    {
        const auto store = open();
        EXPECT_EQ(store->damaged_lines(), 1U);
        EXPECT_EQ(store->damage(), "1 line lacks the right checksum (" + path + ":" +
                                       std::to_string(line) +
                                       "): cut off, changed, or written by an older version");
    }
    const auto mended = limits();
    std::filesystem::remove(path);
    const auto fresh = run_whole(known_limits(), runner_of(*open(), 1), stop);
    EXPECT_EQ(mended, limits_of(known_limits(), fresh->value()));
}

TEST_F(SessionFile, UsesNoLineWithoutAChecksum)
{
    std::ignore = run_whole(known_limits(), runner_of(*open(), 1), stop);
    std::istringstream lines{text()};
    std::string old, line;
    std::size_t sessions = 0;
    for (; std::getline(lines, line); old += line + '\n') {
        const auto sum = line.find(",\"sum\":");
        if (sum == std::string::npos) continue;
        line = line.substr(0, sum) + '}'; // as version 0.2 wrote it
        ++sessions;
    }
    std::ofstream{path} << old;
    const auto store = open();
    EXPECT_EQ(store->damaged_lines(), sessions);
    std::ignore = run_whole(known_limits(), runner_of(*store, 1), stop);
    EXPECT_EQ(store->counts().reused, 0U);
}

TEST_F(SessionFile, OfADiskThatIsFullKeepsNoPartOfALine)
{
    const auto store = open();
    const auto before = text();
    std::signal(SIGXFSZ, SIG_IGN); // a file that is too long stands for a full disk
    rlimit limit{};
    ASSERT_EQ(getrlimit(RLIMIT_FSIZE, &limit), 0);
    rlimit small = limit;
    small.rlim_cur = before.size() + 20;
    ASSERT_EQ(setrlimit(RLIMIT_FSIZE, &small), 0);
    EXPECT_THROW(std::ignore = run_whole(known_limits(), runner_of(*store, 1), stop),
                 std::system_error);
    EXPECT_EQ(setrlimit(RLIMIT_FSIZE, &limit), 0);
    EXPECT_EQ(text(), before);
}

TEST(PlayInVirtualTime, OfASessionThatEndsInSilenceTellsHowFarCopiesAreApart)
{
    const auto none = [](const std::string& name) { return base::fail(name); };
    const auto claims =
        experiment::load_experiment("beat", none, {.quick = false, .settings = {"seeds=1"}})
            .value();
    const auto spec = std::get<experiment::SilenceJob>(make_jobs(claims).back()).spec;
    const auto played = play_in_virtual_time(spec, false).value();
    EXPECT_EQ(played.apart_m, experiment::apart_after_silence(spec.setting, 1s).value());
    EXPECT_EQ(played.rows, "");
}

TEST(ResultTables, JoinTheLinesOfPartsWhoseColumnsDiffer)
{
    const std::filesystem::path folder = testing::TempDir();
    ResultTables tables{folder};
    std::filesystem::create_symlink(folder / "victim", folder / "t.csv.part");
    results::Table first{"t", {{"value"}, {"a", 1}, {"b"}, {"d", {}, results::Stands::if_filled}}};
    first.add("1ms", 1.25, 2U, std::optional<double>{});
    results::Table second{"t",
                          {{"value"}, {"a", 1}, {"in_json", {}, results::Stands::in_json}, {"c"}}};
    second.add("2,ms", 3.0, 9U, "4,5");
    for (const results::Table& part : {first, second, first}) tables.add(part);
    const results::Table session{"sessions_by_axis", {{"seed"}}};
    tables.add(session);
    EXPECT_EQ(tables.commit(), (std::vector<std::string>{"t.csv", "sessions_by_axis.csv",
                                                         "results.json", "sessions.json"}));
    const auto text_of = [&](const char* name) {
        std::ostringstream out;
        out << std::ifstream{folder / name}.rdbuf();
        return out.str();
    };
    EXPECT_EQ(text_of("t.csv"), "value,a,b,c\n1ms,1.2,2,\n\"2,ms\",3.0,,\"4,5\"\n1ms,1.2,2,\n");
    results::Table all{"t", {}};
    for (const results::Table& part : {first, second, first}) append(all, part);
    EXPECT_EQ(text_of("results.json"), results::json_text(std::vector{all}));
    EXPECT_EQ(text_of("sessions.json"), results::json_text(std::vector{session}));
    EXPECT_FALSE(std::filesystem::exists(folder / "victim")) << "lines waited where a link leads";
    std::filesystem::remove(folder / "t.csv.part");
}

TEST(ProgressText, SaysHowMuchIsLeftOnceAPartIsDone)
{
    EXPECT_EQ(progress_text({10, 0, {30, 0}}, 2s), "30 sessions, 15.0/s");
    EXPECT_EQ(progress_text({10, 2, {60, 40}}, 6s), "100/~500 sessions (20 %), 10.0/s, 40 s left");
    EXPECT_EQ(progress_text({10, 1, {60, 0}}, 6s), "60/~600 sessions (10 %), 10.0/s, 54 s left");
    EXPECT_EQ(progress_text({10, 10, {60, 40}}, 6s), "100/100 sessions (100 %), 10.0/s");
}

} // namespace hapnet::lab::runner::runner_test

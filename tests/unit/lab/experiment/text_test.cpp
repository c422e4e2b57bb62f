// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// The meaning of an experiment's text, and complaints about invalid texts.
#include "emulator/core/profile/paths.hpp"
#include "emulator/core/profile/text.hpp"
#include "lab/experiment/criteria_text.hpp"
#include "lab/experiment/jobs.hpp"
#include "lab/experiment/text.hpp"
#include "scene/text/text.hpp"

#include <gtest/gtest.h>
#include <map>
#include <string>

namespace hapnet::lab::experiment {

namespace {

constexpr std::string_view smallest = "kind = \"table1\"\ntasks = \"T1\"\n";

std::string with(std::string_view more) { return std::string{smallest} + std::string{more}; }

std::string limits(std::string_view range)
{
    return "kind = \"limits\"\ntasks = [\"T1\"]\n[limit.delay]\n" + std::string{range};
}

/// The complaint; empty when there is none.
std::string complaint(const std::string& text, const std::vector<std::string>& settings = {})
{
    const auto experiment = parse_experiment(text, "mine.toml", {false, settings});
    return experiment ? "" : experiment.error().message;
}

void expect_words(const std::string& text, std::initializer_list<std::string_view> words)
{
    for (const std::string_view word : words) {
        EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
    }
}

} // namespace

TEST(ExperimentText, EveryBuiltInExperimentReadsBackAsItIsPrinted)
{
    ASSERT_EQ(built_in_experiments().size(), 21U);
    for (const auto& built_in : built_in_experiments()) {
        for (const bool quick : {false, true}) {
            const auto read = parse_experiment(built_in.text, "it", {quick, {}});
            ASSERT_TRUE(read) << read.error().message;
            const auto printed = to_text(*read);
            const auto again = parse_experiment(printed, "again");
            ASSERT_TRUE(again) << again.error().message << "\n" << printed;
            EXPECT_EQ(to_text(*again), printed);
            EXPECT_TRUE(again->kind == read->kind && again->path == read->path &&
                        again->hands == read->hands && again->tasks == read->tasks);
        }
    }
}

TEST(ExperimentText, TakesItsNetworkFromTheFileOfAProfile)
{
    const base::OpenFile open = [](const std::string& name) -> base::Result<std::string> {
        const std::string inside = "[up]\ndelay = \"40ms\"\n[[at]]\ntime = \"9s\"\n"
                                   "up.loss = \"2%\"\n";
        if (name == "home.toml") return inside;
        if (name == "three.toml") return inside + "[link.\"1-3\"]\ndelay = \"80ms\"\n";
        if (name == "wrong.toml") return "[up]\ndelay = \"40\"\n";
        if (name == "trace.toml") return "[up]\ndelay = { law = \"trace\", file = \"d.csv\" }\n";
        if (name == "d.csv") return "10ms\n20ms\n";
        if (name == "lost.toml") return "[up]\ndelay = { law = \"trace\", file = \"e.csv\" }\n";
        return base::fail("there is no file " + name);
    };
    const auto text = [](std::string_view file) {
        return "profile = \"" + std::string{file} + "\"\n" + std::string{smallest};
    };
    const auto named = parse_experiment(text("home.toml"), "mine.toml", {}, open);
    ASSERT_TRUE(named) << named.error().message;
    const auto same = emulator::parse_profile(*open("home.toml"), "home.toml", {});
    EXPECT_EQ(named->path, same->path);
    EXPECT_EQ(named->timeline, same->timeline);
    const auto again = parse_experiment(to_text(*named), "again"); // it no longer needs a file
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->path, named->path);
    const auto why = [&](const std::string& of) {
        const auto read = parse_experiment(of, "mine.toml", {}, open);
        return read ? "accepted" : read.error().message;
    };
    EXPECT_EQ(why(text("wrong.toml")),
              "mine.toml:1:11: wrong.toml:2:9: '40' has no unit: write 40ms, 40us or 40s");
    EXPECT_EQ(why(text("no.toml")), "mine.toml:1:11: there is no file no.toml");
    EXPECT_EQ(why(text("three.toml")), "mine.toml:1:11: T1, 2 peers: there is no link 1-3 between "
                                       "two: use both, up or down");
    const auto traced = parse_experiment(text("trace.toml"), "mine.toml", {}, open);
    ASSERT_TRUE(traced) << traced.error().message;
    EXPECT_TRUE(std::holds_alternative<emulator::TraceLaw>(traced->path.up.delay.law));
    expect_words(why(text("lost.toml")), {"mine.toml:1:11:", "lost.toml:2:9:", "no file e.csv"});
    EXPECT_EQ(why(text("home.toml") + "[both]\ndelay = \"5ms\"\n"),
              "mine.toml:1:11: a profile is the whole network: write its path, or conditions such "
              "as [both] and [[at]], not both");
}

TEST(ExperimentText, PrintsAsymmetricHandsOwnOperatorsAndOwnAlgorithms)
{
    const auto text = with(R"(
algorithms = ["mine", "base"]
hands = [{ preset = "firm", name = "strong" }, "relaxed"]
[algorithm.mine]
algorithm = "dead-reckoning"
velocity = "sender"
)");
    const auto read = parse_experiment(text, "mine.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(name_of(read->hands), "strong/relaxed");
    EXPECT_EQ(read->algorithms[0].name, "mine");
    const auto again = parse_experiment(to_text(*read), "again");
    ASSERT_TRUE(again) << again.error().message << to_text(*read);
    EXPECT_EQ(again->hands, read->hands);
    expect_words(to_text(*again), {"velocity = \"sender\"", "[algorithm.\"mine\"]"});
    EXPECT_EQ(to_text(*again), to_text(*read));
}

TEST(ExperimentText, HasPeersAndScenesAsAxesOfAPlane)
{
    const std::string plane = "kind = \"plane\"\ntasks = \"T7\"\nalgorithms = \"base\"\nseeds = 1\n"
                              "peers = [2, 5]\nscene = [\"carry\", \"mine.toml\"]\n[plane]\n"
                              "delay = [\"0ms\", \"40ms\"]\njitter = [\"0ms\"]\nloss = [\"0%\"]\n";
    const auto open = [](const std::string& name) -> base::Result<std::string> {
        if (name != "mine.toml") return base::fail(name);
        auto mine = *scene::load_scene("carry", {});
        mine.bodies.front().mass_kg = 0.2;
        return scene::to_text(mine);
    };
    const auto read = parse_experiment(plane, "it", {}, open);
    ASSERT_TRUE(read) << read.error().message;
    const auto jobs = make_jobs(*read);
    ASSERT_EQ(jobs.size(), 8U);
    const auto& last = std::get<SessionJob>(jobs.back());
    EXPECT_EQ(last.spec.setting.players.size(), 5U);
    EXPECT_EQ(last.spec.setting.scene.bodies.front().mass_kg, 0.2);
    const auto again = parse_experiment(to_text(*read), "again", {}, open);
    ASSERT_TRUE(again) << again.error().message << to_text(*read);
    EXPECT_EQ(to_text(*again), to_text(*read));
    expect_words(to_text(*read), {"peers = [2, 5]", "scene = [\"carry\", \"mine.toml\"]"});
}

TEST(ExperimentText, HasConditionsOfSingleLinksBesideThoseOfAll)
{
    const std::string plane = "kind = \"plane\"\ntasks = \"T7\"\nalgorithms = \"base\"\nseeds = 1\n"
                              "peers = 3\n[plane]\ndelay = [\"10ms\", \"40ms\"]\n"
                              "jitter = [\"0ms\"]\nloss = [\"0%\"]\n[all]\nloss = \"1%\"\n"
                              "[link.\"1-2\"]\ndelay = \"90ms\"\n[link.\"3-1\"]\nloss = \"5%\"\n";
    const auto read = parse_experiment(plane, "it");
    ASSERT_TRUE(read) << read.error().message;
    const auto jobs = make_jobs(*read);
    ASSERT_EQ(jobs.size(), 2U);
    const emulator::Profile& last = std::get<SessionJob>(jobs.back()).spec.setting.profile;
    using std::chrono::milliseconds;
    const auto of_12 = profile_of(last, "1-2").path, of_13 = profile_of(last, "1-3").path;
    EXPECT_EQ(of_12.up.delay, emulator::constant(milliseconds{90})) << "whatever is tried on all";
    EXPECT_EQ(of_12.down.delay, emulator::constant(milliseconds{40}));
    EXPECT_EQ(of_13.up.delay, emulator::constant(milliseconds{40}));
    EXPECT_NE(of_13.down.loss, of_13.up.loss);
    EXPECT_EQ(of_13.up.loss, of_12.down.loss);
    const auto again = parse_experiment(to_text(*read), "again");
    ASSERT_TRUE(again) << again.error().message << to_text(*read);
    EXPECT_EQ(again->links, read->links);
    EXPECT_EQ(to_text(*again), to_text(*read));
    expect_words(complaint(plane + "[link.\"1-4\"]\nloss = \"5%\"\n"), {"mine.toml:", "1-4"});
    expect_words(complaint(with("[link.\"1-2\"]\nloss = \"5%\"\n")),
                 {"mine.toml:", "there is no link 1-2 between two", "use both, up or down"});
}

TEST(ExperimentText, BecomesOneBySettings)
{
    const std::string plane = "kind = \"plane\"\ntasks = \"T6\"\nalgorithms = \"base\"\npeers = 3\n"
                              "[plane]\ndelay = [\"0ms\"]\njitter = [\"0ms\"]\nloss = [\"0%\"]\n";
    expect_words(complaint(plane), {"mine.toml:", "the scene 'paper' has 2 hands"});
    EXPECT_EQ(complaint(plane, {"scene=carry"}), "");
    EXPECT_EQ(complaint("kind = \"table1\"\n", {"tasks=T1"}), "") << "what it lacks";
    expect_words(complaint(plane, {"scene=carry", "seeds=0"}), {"--set seeds=0: ", "1 to 1000"});
    expect_words(complaint(plane, {"seeds=2"}), {"the scene 'paper' has 2 hands"});
    expect_words(complaint(with("[quick]\nseeds = 0\n"), {"seeds=3"}), {"from 1 to 1000"});
}

TEST(ExperimentText, SaysWhoCannotPlay)
{
    const std::string plane = "kind = \"plane\"\ntasks = \"T7\"\nalgorithms = "
                              "\"base\"\n[plane]\ndelay = [\"0ms\"]\njitter = [\"0ms\"]\n"
                              "loss = [\"0%\"]\n";
    const auto says = [&](std::vector<std::string> settings) { return complaint(plane, settings); };
    EXPECT_EQ(says({"tasks=T7", "algorithms=base", "peers=8"}), "");
    expect_words(says({"tasks=T6", "algorithms=base", "peers=3"}),
                 {"T6, 3 peers", "the scene 'paper' has 2 hands"});
    expect_words(says({"tasks=T3", "algorithms=base", "peers=3", "scene=paper"}),
                 {"T3, 3 peers", "the scene 'paper' has 2 hands"});
    EXPECT_EQ(says({"tasks=[\"T1\", \"T2\", \"T3\"]", "algorithms=base", "peers=[2, 3]"}), "");
    expect_words(says({"tasks=T7", "algorithms=[\"base\", \"sep\"]", "peers=3"}),
                 {"sep is made for two", "use base"});
    expect_words(says({"tasks=T7", "algorithms=base", "peers=9"}), {"peers", "2", "8"});
    expect_words(says({"tasks=T7", "algorithms=base", "peers=[3, 3]"}), {"3 is there already"});
    expect_words(says({"tasks=T7", "scene=nowhere"}), {"nowhere", "carry"});
    expect_words(complaint("kind = \"table1\"\ntasks = \"T7\"\nalgorithms = \"base\"\npeers = 3\n"),
                 {"kind table1 takes one scene and two peers"});
}

TEST(ExperimentText, QuickCountsOnlyWhenItIsAskedFor)
{
    const auto text = with("seeds = 9\n[both]\ndelay = \"160ms\"\nloss = \"1%\"\n[quick]\n"
                           "seeds = 2\nboth.delay = \"80ms\"\n");
    const auto slow = parse_experiment(text, "it");
    const auto quick = parse_experiment(text, "it", {true, {}});
    ASSERT_TRUE(slow && quick);
    EXPECT_EQ(slow->seeds, 9U);
    EXPECT_EQ(quick->seeds, 2U);
    EXPECT_EQ(quick->path.up.delay, emulator::constant(std::chrono::milliseconds{80}));
    EXPECT_EQ(quick->path.up.loss.size(), 1U); // the rest of [both] stays
}

TEST(ExperimentText, SettingsAreTheLastWordAndNeedNoQuotes)
{
    const auto read = parse_experiment(with("[quick]\nseeds = 2\n"), "it",
                                       {true,
                                        {"seeds=4", "both.delay=100ms", "tasks=[\"T2\", \"T3\"]",
                                         "algorithm.dead-reckoning.velocity=sender"}});
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->seeds, 4U);
    EXPECT_EQ(read->tasks.size(), 2U);
    EXPECT_EQ(read->path.down.delay, emulator::constant(std::chrono::milliseconds{100}));
    expect_words(to_text(*read), {"velocity = \"sender\""});
}

TEST(ExperimentText, SettingsThatDependOnEachOtherMayComeInAnyOrder)
{
    const auto text = limits("to = \"100ms\"\nstep = \"10ms\"\nresolution = \"5ms\"\n");
    EXPECT_EQ(complaint(text, {"limit.delay.from=200ms", "limit.delay.to=300ms"}), "");
}

TEST(ExperimentText, ABadSettingIsNamedWithWhatWouldBeRight)
{
    const std::string text{smallest};
    expect_words(complaint(text, {"duration=20s", "seeds=many"}),
                 {"--set seeds=many: ", "'many'", "whole number from 1 to 1000"});
    expect_words(complaint(text, {"seedz=3"}), {"--set seedz=3: ", "did you mean 'seeds'?"});
    expect_words(complaint(text, {"both.delay=5"}), {"--set both.delay=5: ", "write 5ms"});
    expect_words(complaint(text, {"seeds"}), {"--set seeds: ", "KEY=VALUE"});
    expect_words(complaint(text, {"tasks=[T1]"}), {"--set tasks=[T1]: ", "[\"T1\", \"T3\"]"});
    expect_words(complaint(text, {".=1"}), {"--set .=1: ", "KEY=VALUE"});
}

TEST(ExperimentText, ComplaintsSayWhereAndWhatWouldBeRight)
{
    expect_words(complaint("tasks = \"T1\"\n"), {"mine.toml:1:", "missing key 'kind'"});
    expect_words(complaint("kind = \"limit\"\ntasks = \"T1\"\n"),
                 {"mine.toml:1:8: ", "did you mean 'limits'?"});
    expect_words(complaint("kind = \"table1\"\ntaks = \"T1\"\n"),
                 {"mine.toml:2:1: ", "did you mean 'tasks'?"});
    expect_words(complaint("kind = \"table1\"\n"), {"missing key 'tasks'"});
    expect_words(complaint("kind = \"table1\"\ntasks = [\"T99\"]\n"), {"mine.toml:2:9: ", "T99"});
    expect_words(complaint(with("tasks = [\n")), {"mine.toml:3:"});
    expect_words(complaint(with("algorithms = [\"bse\"]\n")), {"mine.toml:3:14: ", "bse"});
    expect_words(complaint(with("algorithms = [\"a,b\"]\n")), {"letters, digits"});
    expect_words(complaint(with("algorithms = [\"base\", \"base\"]\n")), {"there already"});
    expect_words(complaint(with("seeds = 0\n")), {"mine.toml:3:9: ", "from 1 to 1000"});
    expect_words(complaint(with("duration = \"50ms\"\n")), {"mine.toml:3:12: ", "100ms", "600s"});
    expect_words(complaint(with("hands = \"weak\"\n")), {"mine.toml:3:9: ", "weak"});
    expect_words(complaint(with("hands = [\"firm\"]\n")), {"a list of two"});
    expect_words(complaint(with("[quick]\nseedz = 1\n")), {"seedz"});
    expect_words(complaint(limits("to = \"100ms\"\nstep = \"10ms\"\nresolution = \"3ms\"\n")),
                 {"mine.toml:3:", "a multiple of 'resolution'"});
    expect_words(complaint(limits("to = \"0ms\"\nstep = \"10ms\"\nresolution = \"5ms\"\n")),
                 {"'from' has to be less than 'to'"});
    expect_words(complaint(limits("to = 100\nstep = \"10ms\"\nresolution = \"5ms\"\n")),
                 {"mine.toml:4:6: ", "write 100ms"});
    expect_words(complaint("kind = \"limits\"\ntasks = \"T1\"\nlimit = {}\n"), {"[limit.delay]"});
}

TEST(CriteriaText, ThePapersAreTheDefault)
{
    const auto no_file = [](const std::string&) -> base::Result<std::string> {
        return base::fail("no such file");
    };
    const auto paper = load_criteria("paper", no_file);
    ASSERT_TRUE(paper) << paper.error().message;
    EXPECT_EQ(*paper, metrics::Criteria{});
    const auto misspelt = load_criteria("papr", no_file);
    ASSERT_FALSE(misspelt);
    expect_words(misspelt.error().message, {"'papr'", "did you mean 'paper'?"});
}

TEST(ExperimentText, ANameThatIsNeitherAFileNorAnExperimentIsNamed)
{
    const auto no_file = [](const std::string& name) -> base::Result<std::string> {
        return base::fail("cannot open " + name);
    };
    EXPECT_TRUE(load_experiment("fig6a", no_file, {}));
    const auto misspelt = load_experiment("figg6a", no_file, {});
    ASSERT_FALSE(misspelt);
    expect_words(misspelt.error().message, {"'figg6a'", "did you mean 'fig6a'?"});
    const auto missing = load_experiment("mine.toml", no_file, {});
    ASSERT_FALSE(missing);
    EXPECT_EQ(missing.error().message, "cannot open mine.toml");
}

TEST(ExperimentText, FindsFilesBesideTheExperimentFirst)
{
    const std::string text = "kind = \"trajectories\"\ntasks = [\"T1\"]\n"
                             "algorithms = [\"base\"]\nreplay = [\"hand.csv\", \"\"]\n";
    std::map<std::string, std::string> files{{"moved/mine.toml", text},
                                             {"mine.toml", text},
                                             {"moved/hand.csv", "time_s,x_m,y_m,z_m\n0,0.01,0,0\n"},
                                             {"hand.csv", "time_s,x_m,y_m,z_m\n0,0.02,0,0\n"}};
    const auto open = [&files](const std::string& name) -> base::Result<std::string> {
        const auto found = files.find(name);
        if (found == files.end()) return base::fail("cannot open " + name);
        return found->second;
    };
    const auto x_of = [&open](const std::string& experiment) {
        const auto loaded = load_experiment(experiment, open, {});
        EXPECT_TRUE(loaded) << loaded.error().message;
        return loaded ? loaded->replay.at(0).trace->front().hip.x() : -1.0;
    };
    EXPECT_EQ(x_of("moved/mine.toml"), 0.01);
    EXPECT_EQ(x_of("mine.toml"), 0.02);
    files.erase("moved/hand.csv");
    EXPECT_EQ(x_of("moved/mine.toml"), 0.02) << "or else where the program runs";
    files.erase("hand.csv");
    EXPECT_FALSE(load_experiment("moved/mine.toml", open, {}));
}

TEST(ExperimentText, TakesASessionsLengthFromItsScript)
{
    const auto open = [](const std::string& name) -> base::Result<std::string> {
        if (name == "long.csv") return "time_s,x_m,y_m,z_m\n0,0,0,0\n12.5,0.01,0,0\n";
        return "time_s,x_m,y_m,z_m\n0,0,0,0\n1.2,0.01,0,0\n";
    };
    const auto duration = [&](std::string_view more) {
        const auto read =
            parse_experiment(with("duration = \"script\"\n" + std::string{more}), "it", {}, open);
        return read ? base::to_text(read->duration) : read.error().message;
    };
    EXPECT_EQ(duration("script = [\"long.csv\", \"short.csv\"]\n"), "15500ms");
    EXPECT_EQ(duration("replay = [\"short.csv\", \"\"]\n"), "2400ms") << "hands off for half";
    EXPECT_EQ(duration(""), "it:3:12: there is no script or replay to take the duration from: name "
                            "one, or recorded hands, or write a time");
}

TEST(ExperimentText, RefusesACombinationThatCannotPlayBeforeTheFirstSession)
{
    const auto text = with("algorithms = [\"base\", \"rollback\"]\n");
    EXPECT_EQ(complaint(text), "");
    EXPECT_TRUE(complaint("kind = \"table1\"\ntasks = [\"T1\", \"T4\"]\n"
                          "algorithms = [\"base\", \"rollback\"]\n")
                    .starts_with("mine.toml:3:14: T4, 2 peers: "));
    EXPECT_TRUE(complaint("kind = \"claims\"\ntasks = \"T1\"\nalgorithms = \"sep\"\n")
                    .starts_with("mine.toml:3:14: T1, 3 peers: "));
    EXPECT_EQ(complaint("kind = \"table1\"\ntasks = \"T1\"\ntick = \"2ms\"\nrecord = true\n"),
              "mine.toml:4:10: a record has ticks of 1 ms: leave 'tick' out");
}

TEST(ExperimentText, NamesThePlaceOfAnAxisWhetherItStandsAloneOrAmongSeveral)
{
    const auto why = [](std::string_view head) {
        const auto text = with("[both]\ndelay = \"5ms\"\n" + std::string{head} +
                               "\nkey = \"both.delay\"\nvalues = [\"1ms\", \"fast\"]\n");
        const auto open = [&](const std::string&) -> base::Result<std::string> { return text; };
        const auto points = load_axis_points("mine.toml", open, {});
        return points ? "accepted" : points.error().message;
    };
    EXPECT_TRUE(why("[axis]").starts_with("mine.toml:6:7: axis both.delay=fast: "))
        << why("[axis]");
    EXPECT_TRUE(why("[[axis]]").starts_with("mine.toml:6:7: axis both.delay=fast: "));
}

} // namespace hapnet::lab::experiment

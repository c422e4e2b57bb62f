// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/experiment/axes.hpp"

#include "lab/experiment/text.hpp"

#include <algorithm>
#include <charconv>
#include <gtest/gtest.h>
#include <map>
#include <set>
#include <stdexcept>

namespace hapnet::lab::experiment::axes_test {
namespace {

constexpr std::string_view head = R"(
kind = "plane"
seeds = 1
algorithms = "base"
tasks = "T1"
[plane]
delay = "0ms"
jitter = "0ms"
loss = "0%"
)";

std::string with(std::string_view axes) { return std::string{head} + std::string{axes}; }

constexpr std::string_view three = R"(
[[axis]]
key = "plane.delay"
from = "0ms"
to = "200ms"
[[axis]]
key = "plane.loss"
from = "10%"
to = "90%"
[[axis]]
key = "hands"
values = ["relaxed", "nominal", "firm"]
[latin_hypercube]
points = 30
)";

std::vector<AxisValues> points(const std::string& text)
{
    const auto experiment = parse_experiment(text, "mine.toml");
    if (!experiment) throw std::runtime_error{experiment.error().message};
    return axis_points(*experiment).value();
}

std::string complaint_of(const std::string& text)
{
    const auto experiment = parse_experiment(text, "mine.toml");
    return experiment ? "" : experiment.error().message;
}

double number(const std::string& text)
{
    double value = -1.0;
    std::from_chars(text.data(), text.data() + text.size(), value);
    return value;
}

} // namespace

TEST(Axes, OfAGridAreCombinedTheLastFirst)
{
    const auto all = points(with("[[axis]]\nkey = \"plane.delay\"\nfrom = \"0ms\"\nto = \"0.3ms\"\n"
                                 "step = \"0.1ms\"\n[[axis]]\nkey = \"hands\"\n"
                                 "values = [\"relaxed\", \"firm\"]\n"));
    const std::vector<AxisValues> expected{
        {"0ms", "relaxed"},   {"0ms", "firm"},   {"0.1ms", "relaxed"}, {"0.1ms", "firm"},
        {"0.2ms", "relaxed"}, {"0.2ms", "firm"}, {"0.3ms", "relaxed"}, {"0.3ms", "firm"}};
    EXPECT_EQ(all, expected);
    EXPECT_EQ(points(with("")), std::vector<AxisValues>(1));
}

TEST(Axes, OfALatinHypercubeHaveEachPartOfTheirRangeOnce)
{
    const auto all = points(with(three));
    ASSERT_EQ(all.size(), 30U);
    std::set<int> delays, losses;
    std::map<std::string, int> hands;
    for (const AxisValues& point : all) {
        ASSERT_EQ(point.size(), 3U);
        EXPECT_TRUE(point[0].ends_with("ms") && point[1].ends_with("%"));
        // A rounded value may lie on the edge of its part, so the part's middle decides.
        delays.insert(static_cast<int>((number(point[0]) - 1e-9) / 200.0 * 30.0));
        losses.insert(static_cast<int>((number(point[1]) - 10.0 - 1e-9) / 80.0 * 30.0));
        ++hands[point[2]];
    }
    EXPECT_EQ(delays.size(), 30U);
    EXPECT_EQ(losses.size(), 30U);
    EXPECT_EQ(hands, (std::map<std::string, int>{{"relaxed", 10}, {"nominal", 10}, {"firm", 10}}));
}

TEST(Axes, AreDrawnFromTheSeedEachOnItsOwn)
{
    const auto all = points(with(three));
    EXPECT_EQ(points(with(three)), all);
    EXPECT_NE(points(with(three) + "seed = 2\n"), all);
    std::string less{three}; // without the second axis
    const auto second = less.find("[[axis]]", 5);
    less.erase(second, less.find("[[axis]]", second + 5) - second);
    const auto fewer = points(with(less));
    for (std::size_t i = 0; i < all.size(); ++i)
        EXPECT_EQ(fewer[i], (AxisValues{all[i][0], all[i][2]}));
}

TEST(Axes, OfALatinHypercubeKeepToTheirSteps)
{
    const auto all = points(with("[axis]\nkey = \"seeds\"\nfrom = \"1\"\nto = \"4\"\nstep = \"1\"\n"
                                 "[latin_hypercube]\npoints = 8\n"));
    std::map<std::string, int> counts;
    for (const AxisValues& point : all) ++counts[point[0]];
    EXPECT_EQ(counts, (std::map<std::string, int>{{"1", 2}, {"2", 2}, {"3", 2}, {"4", 2}}));
}

TEST(Axes, GoIntoTheExperimentsOfTheirPoints)
{
    const auto no_file = [&](const std::string&) -> base::Result<std::string> {
        return with(three);
    };
    const auto loaded =
        load_axis_points("mine.toml", no_file, {false, {"latin_hypercube.points=4", "seeds=3"}});
    ASSERT_TRUE(loaded) << loaded.error().message;
    ASSERT_EQ(loaded->size(), 4U);
    for (const AxisPoint& point : *loaded) {
        EXPECT_TRUE(point.experiment.axes.empty() && !point.experiment.latin_hypercube);
        EXPECT_EQ(point.experiment.seeds, 3U);
        EXPECT_EQ(name_of(point.experiment.hands), point.values[2]);
        const auto& plane = std::get<ImpairmentGrid>(point.experiment.kind);
        EXPECT_NEAR(in_units(plane.delays.front()), number(point.values[0]), 1e-9);
        EXPECT_NEAR(in_units(plane.losses.front()), number(point.values[1]), 1e-9);
    }
}

TEST(Axes, ReadBackAsTheyArePrinted)
{
    const auto read = parse_experiment(with(three), "mine.toml");
    ASSERT_TRUE(read);
    const auto again = parse_experiment(to_text(*read), "again");
    ASSERT_TRUE(again) << again.error().message << to_text(*read);
    EXPECT_EQ(again->axes, read->axes);
    EXPECT_EQ(again->latin_hypercube, read->latin_hypercube);
    EXPECT_EQ(to_text(*again), to_text(*read));
}

TEST(Axes, HaveAReferenceAmongTheirValues)
{
    const std::string table = "kind = \"table1\"\ntasks = \"T1\"\n[axis]\nkey = \"tick\"\n"
                              "values = [\"2ms\", \"1ms\"]\nreference = ";
    const auto read = parse_experiment(table + "\"1ms\"\n", "mine.toml");
    ASSERT_TRUE(read) << read.error().message;
    EXPECT_EQ(read->axes.front().reference, "1ms");
    const auto again = parse_experiment(to_text(*read), "again");
    ASSERT_TRUE(again) << again.error().message;
    EXPECT_EQ(again->axes, read->axes);
    EXPECT_NE(complaint_of(table + "\"3ms\"\n").find("'3ms' is not among the values"),
              std::string::npos);
    std::string two = table + "\"1ms\"\n";
    two.replace(two.find("[axis]"), 6, "[[axis]]");
    two += "[[axis]]\nkey = \"seeds\"\nvalues = [\"1\", \"2\"]\n";
    EXPECT_NE(complaint_of(two).find("an experiment of one axis"), std::string::npos);
}

TEST(Axes, SayWhatIsWrongAndWhatWouldBeRight)
{
    const auto says = [](std::string_view axis, std::initializer_list<std::string_view> words) {
        const auto text = complaint_of(with(axis));
        for (const std::string_view word : words)
            EXPECT_NE(text.find(word), std::string::npos) << word << "\n" << text;
    };
    const std::string delay = "[axis]\nkey = \"plane.delay\"\n";
    says(delay, {"mine.toml:", "axis 'plane.delay'", "write values = "});
    says(delay + "from = \"0ms\"\n", {"write values = ", "and to = \"200ms\""});
    says(delay + "from = \"0ms\"\nto = \"9ms\"\n", {"needs a step", "[latin_hypercube]"});
    says(delay + "from = \"0ms\"\nto = \"9s\"\nstep = \"1s\"\n", {"the same unit"});
    says(delay + "from = \"5ms\"\nto = \"5ms\"\nstep = \"1ms\"\n", {"'from' has to be less"});
    says(delay + "from = \"0ms\"\nto = \"5ms\"\nstep = \"0ms\"\n", {"'step' is a number"});
    says(delay + "from = \"0ms\"\nto = \"5ms\"\nstep = \"1us\"\n", {"'step' is a number"});
    says(delay + "from = \"0ms\"\nto = \"5ms\"\nstep = \"0.0001ms\"\n", {"more than 10000 steps"});
    says("[latin_hypercube]\npoints = 5\n", {"needs an [[axis]]"});
    const std::string held = "values = [\"0ms\", \"5ms\"]\nreference = ";
    says(delay + held + "\"5ms\"\n", {"axis 'plane.delay'", "the kinds table1 and limits"});
    says(delay + "values = [\"0ms\"]\n[latin_hypercube]\npoints = 1\n", {"from 2 to 10000"});
    const std::string twice = "[[axis]]\nkey = \"seeds\"\nvalues = [\"1\", \"2\"]\n";
    says(twice + twice, {"axis 'seeds'", "there already"});
    std::string many;
    for (const char* key : {"a", "b", "c", "d", "e"}) {
        many += std::string{"[[axis]]\nkey = \""} + key + "\"\nfrom = \"0\"\nto = \"9\"\n" +
                "step = \"1\"\n";
    }
    says(many, {"more than 10000 points", "[latin_hypercube]"});
}

TEST(Axes, OfWhichAPointIsNoExperimentNameTheirPlaceAndTheValue)
{
    const auto text = with("[axis]\nkey = \"seeds\"\nfrom = \"1\"\nto = \"2\"\n"
                           "[latin_hypercube]\npoints = 3\n");
    const auto open = [&](const std::string&) -> base::Result<std::string> { return text; };
    const auto loaded = load_axis_points("mine.toml", open, {});
    ASSERT_FALSE(loaded);
    EXPECT_EQ(loaded.error().message.find(": axis seeds=1."), std::string{"mine.toml:11:7"}.size())
        << loaded.error().message;
}

} // namespace hapnet::lab::experiment::axes_test

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
// A stored session is found again by its key, which changes with everything that affects the
// session.
#include "lab/experiment/jobs.hpp"
#include "lab/experiment/session_spec.hpp"
#include "lab/experiment/text.hpp"
#include "scene/text/text.hpp"

#include <gtest/gtest.h>
#include <map>
#include <variant>

namespace hapnet::lab::experiment {

namespace {

using Files = std::map<std::string, std::string>;

/// The key of the first session of an experiment that has these files.
std::string key_with(const std::string& text, const Files& files)
{
    const auto open = [&](const std::string& name) -> base::Result<std::string> {
        const auto file = files.find(name);
        if (file == files.end()) return base::fail("there is no file " + name);
        return file->second;
    };
    const auto experiment = parse_experiment(text, "mine.toml", {}, open);
    if (!experiment) {
        ADD_FAILURE() << experiment.error().message;
        return {};
    }
    const auto jobs = make_jobs(*experiment);
    return key_of(std::get<SessionJob>(jobs.front()).spec, "a program");
}

/// An experiment with one line more at the top, or with tables at its end.
std::string experiment(std::string_view top, std::string_view tables = {})
{
    return std::string{top} +
           "\nkind = \"trajectories\"\ntasks = \"T1\"\nalgorithms = [\"base\"]\n" +
           std::string{tables};
}

std::string scene_text(double mass_kg)
{
    auto scene = scene::paper_scene();
    scene.bodies.front().mass_kg = mass_kg;
    return scene::to_text(scene);
}

std::string hand(std::string_view x)
{
    return "time_s,x_m,y_m,z_m\n0,0,0,0\n1," + std::string{x} + ",0,0\n";
}

struct Changed {
    std::string text;
    std::string file;
    std::string before;
    std::string after;
    Files others{};
};

const std::string up_delay_trace = "[up]\ndelay = { law = \"trace\", file = \"f\" }\n";

const std::vector<Changed> changes{
    {experiment("", up_delay_trace), "f", "10ms\n20ms\n", "10ms\n90ms\n"},
    {experiment("", "[both]\ndelay = { law = \"table\", file = \"f\" }\n"), "f", "10ms\n20ms\n",
     "10ms\n90ms\n"},
    {experiment("", "[both]\ndelay = { law = \"table\", file = \"f.dist\", mean = \"20ms\", "
                    "sd = \"5ms\" }\n"),
     "f.dist", "-8192 0 8192\n", "-8192 0 4096\n"},
    {experiment("", "[down]\nloss = { law = \"trace\", file = \"f\" }\n"), "f", "0 1 0\n",
     "0 1 1\n"},
    {experiment("", "[down]\nloss = { law = \"timed-trace\", file = \"f\" }\n"), "f",
     "t_ms,loss\n0,0\n10,1\n", "t_ms,loss\n0,0\n20,1\n"},
    {experiment("", "[both]\nrate = { law = \"trace\", file = \"f\" }\n"), "f", "1\n2\n", "1\n5\n"},
    {experiment("", "[[at]]\ntime = \"3s\"\nup.delay = { law = \"trace\", file = \"f\" }\n"), "f",
     "10ms\n20ms\n", "10ms\n90ms\n"},
    {experiment("profile = \"f\""), "f", "[up]\ndelay = \"10ms\"\n", "[up]\ndelay = \"11ms\"\n"},
    {experiment("profile = \"p\""), "f", "10ms\n20ms\n", "10ms\n90ms\n", {{"p", up_delay_trace}}},
    {experiment("scene = \"f.toml\""), "f.toml", scene_text(0.1), scene_text(0.2)},
    {experiment("script = [\"f\", \"\"]"), "f", hand("0.01"), hand("0.02")},
    {experiment("replay = [\"\", \"f\"]"), "f", hand("0.01"), hand("0.02")},
};

} // namespace

TEST(SessionKey, ChangesWithTheContentsOfEveryFileThatAnExperimentCanName)
{
    for (const Changed& one : changes) {
        Files files = one.others;
        files[one.file] = one.before;
        const auto before = key_with(one.text, files);
        EXPECT_EQ(key_with(one.text, files), before);
        files[one.file] = one.after;
        EXPECT_NE(key_with(one.text, files), before) << one.text;
    }
}

TEST(SessionKey, StaysWhenAFileChangesThatTheSessionDoesNotPlay)
{
    const auto text = experiment("", up_delay_trace);
    const auto perfect = [&](const std::string& trace) {
        const auto open = [&](const std::string&) -> base::Result<std::string> { return trace; };
        const auto read = parse_experiment(text, "mine.toml", {}, open);
        const auto jobs = make_jobs(read.value());
        return key_of(perfect_twin(std::get<SessionJob>(jobs.front()).spec), "a program");
    };
    EXPECT_EQ(perfect("10ms\n"), perfect("90ms\n"));
}

} // namespace hapnet::lab::experiment

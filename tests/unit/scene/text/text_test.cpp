// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "scene/text/text.hpp"

#include <cmath>
#include <gtest/gtest.h>
#include <limits>

namespace hapnet::scene {
namespace {

Description read(std::string_view text)
{
    const auto scene = parse_scene(text, "s.toml");
    EXPECT_TRUE(scene) << scene.error().message;
    return scene.value_or(Description{});
}

std::string complaint(std::string_view text)
{
    const auto scene = parse_scene(text, "s.toml");
    return scene ? "none" : scene.error().message;
}

/// The scene with one body that has these keys besides its size and mass.
std::string with_body(std::string_view keys)
{
    return "[[body]]\nsize = \"40mm\"\nmass = \"100g\"\n" + std::string{keys};
}

TEST(SceneText, AnEmptyTextIsASceneWithoutAnythingInIt) { EXPECT_EQ(read(""), Description{}); }

TEST(SceneText, ReadsWhatABodyMayHave)
{
    const auto scene = read(R"(
        [[body]]
        name = "slab"
        size = ["40mm", "4cm", "0.5m"]
        position = ["22.5mm", "-1um", 0]
        orientation = { axis = [0, 0, 2], angle = "180deg" }
        velocity = ["0.2m/s", "0m/s", "-5mm/s"]
        angular_velocity = ["1rad/s", "0rad/s", "90deg/s"]
        density = "1g/cm3"
        turning = "about-z"
        locked = ["y", "x"]
        friction = 0.3
        restitution = 1
        drag = "10Ns/m"
    )");
    ASSERT_EQ(scene.bodies.size(), 1U);
    const BodyDescription& body = scene.bodies[0];
    EXPECT_EQ(body.name, "slab");
    EXPECT_TRUE(body.movable);
    EXPECT_EQ(body.half, (glm::dvec3{0.02, 0.02, 0.25}));
    EXPECT_EQ(body.position.value, (glm::dvec3{0.0225, -1e-6, 0.0}));
    EXPECT_NEAR(body.orientation.w, 0.0, 1e-16);
    EXPECT_EQ(body.orientation.z, 1.0);
    EXPECT_EQ(body.velocity.value, (glm::dvec3{0.2, 0.0, -0.005}));
    EXPECT_NEAR(body.angular_velocity.z, std::acos(0.0), 1e-15);
    EXPECT_NEAR(body.mass_kg, 0.8, 1e-15);
    EXPECT_EQ(body.turning, Turning::about_z);
    EXPECT_TRUE(body.locked.x && body.locked.y && !body.locked.z);
    EXPECT_EQ(body.material, (Material{0.3, 1.0}));
    EXPECT_EQ(body.drag_ns_per_m, 10.0);
}

TEST(SceneText, ReadsHandsPlanesAndGravity)
{
    const auto scene = read(R"(
        name = "x"
        gravity = [0, "-1.62m/s2", 0]
        hips = { count = 1, radius = "1mm", stiffness = "1e6N/m", damping = 0, force_max = "none" }
        [[plane]]
        normal = [3, 4, 0]
        offset = "-20mm"
        friction = 0.5
    )");
    EXPECT_EQ(scene.gravity, (glm::dvec3{0.0, -1.62, 0.0}));
    EXPECT_EQ(scene.hands.count, 1U);
    EXPECT_EQ(scene.hands.stiffness_n_per_m, 1e6);
    EXPECT_EQ(scene.hands.damping_ns_per_m, 0.0);
    EXPECT_EQ(scene.hands.force_max_n, std::numeric_limits<double>::infinity());
    EXPECT_EQ(scene.hands.grip_reach_m, HandDescription{}.grip_reach_m);
    EXPECT_EQ(scene.planes.at(0).normal, (glm::dvec3{0.6, 0.8, 0.0}));
    EXPECT_EQ(scene.planes.at(0).offset_m, -0.02);
}

TEST(SceneText, BodiesAreCountedInTheOrderOfTheTextAndArraysLayByLayer)
{
    const auto scene = read(R"(
        [[array]]
        name = "a"
        count = [2, 2, 2]
        spacing = ["1m", "2m", "3m"]
        size = "40mm"
        mass = "100g"
        position = ["1m", "1m", "1m"]
        [[body]]
        name = "b"
        size = "40mm"
        fixed = true
        [[array]]
        count = [1, 1, 1]
        spacing = [0, 0, 0]
        size = "40mm"
        fixed = true
    )");
    ASSERT_EQ(scene.bodies.size(), 10U);
    const std::vector<glm::dvec3> expected{{1, 1, 1}, {2, 1, 1}, {1, 1, 4}, {2, 1, 4},
                                           {1, 3, 1}, {2, 3, 1}, {1, 3, 4}, {2, 3, 4}};
    for (std::size_t i = 0; i < expected.size(); ++i) {
        EXPECT_EQ(scene.bodies[i].position.value, expected[i]) << i;
        EXPECT_EQ(scene.bodies[i].name, "a " + std::to_string(i + 1));
    }
    EXPECT_EQ(scene.bodies[8].name, "b");
    EXPECT_EQ(scene.bodies[9].name, "");
}

TEST(SceneText, NamesThePlaceOfWhatIsWrongAndWhatIsPossible)
{
    struct Case {
        std::string text;
        std::vector<std::string> words;
    };
    const std::vector<Case> cases{
        {"x = ", {"s.toml:1:"}},
        {"bodies = 1", {"s.toml:1:1: ", "'bodies'", "did you mean 'body'?"}},
        {"body = 1", {"s.toml:1:8: ", "[[body]]"}},
        {"gravity = \"1m/s2\"", {"s.toml:1:11: ", "list of three", "acceleration"}},
        {"gravity = [0, 1]", {"s.toml:1:11: ", "not 2", "three values"}},
        {"gravity = [0, -9.81, 0]", {"s.toml:1:15: ", "'-9.81'", "-9.81m/s2"}},
        {"[hips]\ncount = 9", {"s.toml:2:9: ", "0 to 8"}},
        {"[hips]\nforce_max = \"nine\"", {"s.toml:2:13: ", "3.3N"}},
        {"[hips]\nstiffness = \"500N\"", {"s.toml:2:13: ", "'500N' is not a stiffness", "500N/m"}},
        {"[[plane]]\nnormal = [0, 0, 0]", {"s.toml:2:10: ", "cannot be zero"}},
        {"[[body]]\nsize = \"40mm\"", {"s.toml:1:1: ", "'mass' or 'density' is missing"}},
        {"[[body]]\nmas = \"1kg\"", {"s.toml:2:1: ", "did you mean 'mass'?"}},
        {"[[body]]\nmass = \"1kg\"", {"s.toml:1:1: ", "missing key 'size'"}},
        {with_body("density = \"1g/cm3\""), {"s.toml:4:11: ", "leave out one"}},
        {with_body("size_ = 1"), {"s.toml:4:1: ", "did you mean 'size'?"}},
        {with_body("position = [0, \"2km\", 0]"), {"s.toml:4:16: ", "40mm"}},
        {with_body("position = [0, \"2000m\", 0]"), {"s.toml:4:16: ", "use -1000m to 1000m"}},
        {with_body("friction = -0.1"), {"s.toml:4:12: ", "0 to 10"}},
        {with_body("friction = \"30%\""), {"s.toml:4:12: ", "a number without a unit"}},
        {with_body("turning = \"lockd\""), {"s.toml:4:11: ", "did you mean 'locked'?"}},
        {with_body("locked = [\"w\"]"), {"s.toml:4:11: ", "\"x\", \"y\" or \"z\""}},
        {with_body("fixed = 1"), {"s.toml:4:9: ", "true or false"}},
        {with_body("orientation = { axis = [0, 1, 0] }"), {"s.toml:4:15: ", "missing key 'angle'"}},
        {with_body("orientation = \"30deg\""), {"s.toml:4:15: ", "axis = [0, 1, 0]"}},
        {with_body("[[array]]\nsize = \"1m\"\nmass = \"1kg\"\nspacing = [0, 0, 0]\n"
                   "count = [1000, 1, 101]"),
         {"s.toml:8:9: ", "100000 bodies"}},
        {"[[array]]\nsize = \"1m\"\nmass = \"1kg\"\ncount = [2, 1, 1]\nspacing = [\"1km\", 0, 0]",
         {"s.toml:5:12: "}},
        {"[[array]]\nsize = \"1m\"\nfixed = true\ncount = [3, 1, 1]\nspacing = [\"900m\", 0, 0]",
         {"s.toml:1:1: ", "position in m is 1800"}},
        {"[[body]]\nsize = \"200m\"\ndensity = \"1g/cm3\"",
         {"s.toml:3:11: ", "8e+09 kg", "1000000kg"}},
    };
    for (const Case& c : cases) {
        const std::string message = complaint(c.text);
        for (const std::string& word : c.words) {
            EXPECT_NE(message.find(word), std::string::npos) << c.text << "\n" << message;
        }
    }
}

TEST(SceneText, TheBuiltInPaperSceneIsThePapers)
{
    const auto scene = load_scene("paper", {});
    ASSERT_TRUE(scene) << scene.error().message;
    EXPECT_EQ(*scene, paper_scene());
    EXPECT_EQ(hash(*scene), hash(paper_scene()));
}

TEST(SceneText, EveryBuiltInSceneReadsUnderItsNameAndPrintsAsItself)
{
    const std::vector<std::pair<std::string_view, std::size_t>> expected{
        {"paper", 2},  {"mass-ratio-1000", 2}, {"push-6dof", 2},      {"lift", 1},
        {"wall", 2},   {"guide", 2},           {"rolling", 7},        {"carry", 2},
        {"hammer", 3}, {"turning", 1},         {"stack-of-three", 3}, {"bench", 4}};
    for (const auto& [name, bodies] : expected) {
        const auto scene = load_scene(std::string{name}, {});
        ASSERT_TRUE(scene) << scene.error().message;
        EXPECT_EQ(scene->name, name);
        EXPECT_EQ(scene->bodies.size(), bodies);
        EXPECT_EQ(read(to_text(*scene)), *scene) << name;
    }
    EXPECT_EQ(built_in_scenes().size(), expected.size());
}

TEST(SceneText, TheNameOfARemovedSceneSaysWhereItWent)
{
    const base::OpenFile no_file = [](const std::string& name) -> base::Result<std::string> {
        return base::fail("cannot read " + name);
    };
    EXPECT_EQ(load_scene("cubes-100", no_file).error().message,
              "no scene is called 'cubes-100' since version 0.3: it is the file "
              "tests/bench/scenes/cubes-100.toml of the source code");
    EXPECT_EQ(load_scene("door", no_file).error().message,
              "no scene is called 'door' since version 0.3: scenes have no joints");
}

TEST(SceneText, AJointSaysThatScenesHaveNone)
{
    const std::string message = complaint("[[body]]\nsize = \"40mm\"\nmass = \"100g\"\n"
                                          "[[hinge]]\nbody = 0\n");
    EXPECT_NE(message.find(":4:"), std::string::npos) << message;
    EXPECT_NE(message.find("scenes have no joints since version 0.3"), std::string::npos)
        << message;
}

TEST(SceneText, AFileIsReadAndAnUnknownNameGetsASuggestion)
{
    const base::OpenFile open = [](const std::string& name) -> base::Result<std::string> {
        if (name == "my" || name == "./paper") return "name = \"mine\"";
        return base::fail("cannot read " + name);
    };
    EXPECT_EQ(load_scene("my", open).value().name, "mine");
    EXPECT_EQ(load_scene("./paper", open).value().name, "mine");
    EXPECT_EQ(load_scene("no.toml", open).error().message, "cannot read no.toml");
    const auto unknown = load_scene("papr", open);
    EXPECT_NE(unknown.error().message.find("did you mean 'paper'?"), std::string::npos);
}

} // namespace
} // namespace hapnet::scene

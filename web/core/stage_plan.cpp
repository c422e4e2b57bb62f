// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/stage_plan.hpp"

#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <spdlog/fmt/fmt.h>
#include <spdlog/fmt/ranges.h>

namespace hapnet::web {

namespace {

using Json = nlohmann::ordered_json;

constexpr std::int64_t virtual_seed_max = 1'000'000'000; // limit for an experiment
constexpr int lab_others_max = 2; // algorithms in parallel with the chosen one
constexpr const char* own_scene = "task";
constexpr const char* held_for = "20s"; // the longest time that a trap may ask for
constexpr std::int64_t seed_max = (std::int64_t{1} << 53) - 1; // exact in JavaScript

/// Reads the members of a request into a choice and remembers the first error.
class ChoiceReader {
public:
    explicit ChoiceReader(const Json& json) : json_{json} {}

    void one_of(const char* key, const std::vector<std::string>& all, std::string& into)
    {
        const auto found = json_.find(key);
        if (found == json_.end()) return;
        if (found->is_string() &&
            std::ranges::find(all, found->get_ref<const std::string&>()) != all.end()) {
            into = found->get<std::string>();
        } else {
            fail(fmt::format("\"{}\" must be one of {}", key, fmt::join(all, ", ")));
        }
    }

    template <typename Number>
    void number(const char* key, std::int64_t least, std::int64_t most, Number& into)
    {
        const auto found = json_.find(key);
        if (found == json_.end()) return;
        if (found->is_number_integer() && *found >= least && *found <= most) {
            into = found->get<Number>();
        } else {
            fail(fmt::format("\"{}\" must be a whole number from {} to {}", key, least, most));
        }
    }

    void truth(const char* key, bool& into)
    {
        const auto found = json_.find(key);
        if (found == json_.end()) return;
        if (found->is_boolean()) {
            into = found->get<bool>();
        } else {
            fail(fmt::format("\"{}\" must be true or false", key));
        }
    }

    void refuse_others()
    {
        constexpr std::array known{"do",     "story", "mode",    "task", "algorithm", "scene",
                                   "preset", "peers", "seconds", "seed", "loop",      "device"};
        for (const auto& [name, value] : json_.items()) {
            if (std::ranges::find(known, name) == known.end()) {
                fail(fmt::format("\"{}\" is not known here", name));
            }
        }
    }

    void fail(std::string why)
    {
        if (why_.empty()) why_ = std::move(why);
    }

    [[nodiscard]] const std::string& why() const { return why_; }

private:
    const Json& json_;
    std::string why_;
};

std::string pair_name(int a, int b) { return fmt::format("{}-{}", a, b); }

/// The scenes in which a session of two can play every task. The project's other scenes share too
/// many bodies, have joints, or have hands of different kinds.
constexpr std::array scenes_of_two{"bench",   "carry",           "guide",   "hammer",
                                   "lift",    "mass-ratio-1000", "paper",   "push-6dof",
                                   "rolling", "stack-of-three",  "turning", "wall"};

std::vector<Story> all_stories()
{
    return {
        {"paper-160",
         "The paper's 160 ms",
         "Watch the two cubes: B's follows A's about 160 ms late, so the faster the hand, the "
         "larger the number between them.",
         {.task = "P1", .algorithm = "base", .preset = "paper-delay-160"}},
        {"dead-reckoning-shakes",
         "Why dead reckoning shakes",
         "Watch B's cube tremble: it is extrapolated from messages that jitter delivers in the "
         "wrong order, and each one throws it to another place.",
         {.task = "P1", .algorithm = "dead-reckoning", .preset = "paper-jitter-15"}},
        {"loss-97",
         "97 % loss with remote-proxy",
         "Watch the wire: it drops 97 of 100 datagrams, and the copies stay together, because the "
         "few that arrive say where the other hand means to go.",
         {.task = "T3", .algorithm = "remote-proxy", .preset = "loss-97"}},
        {"starlink",
         "Starlink",
         "Watch the delay: it wanders by tens of milliseconds, and where the dish changes its "
         "satellite the wire goes dark for a moment and the cubes part.",
         {.task = "T1", .algorithm = "sep", .preset = "starlink"}},
        {"lte-car",
         "LTE in a car",
         "Watch the two directions: up is slower than down, and each handover from cell to cell "
         "stops both for a moment, after which the copies find each other again.",
         {.task = "T1", .algorithm = "base", .preset = "lte-car"}},
    };
}

std::vector<std::string> names_of(const std::vector<Story>& stories)
{
    std::vector<std::string> names;
    for (const Story& story : stories) names.push_back(story.name);
    return names;
}

/// Returns the device of a peer in the form for its command line.
const char* device_of(int id, const Choice& choice)
{
    return id == 1 && choice.device == "page" ? "page" : "sim";
}

/// True for tasks for more than two hands.
bool is_for_many(std::string_view task) { return task == "T7" || task == "T8"; }

} // namespace

nlohmann::ordered_json Choices::json() const
{
    Json told = Json::array();
    for (const Story& story : stories) told.push_back(story.json());
    return {{"modes", modes},
            {"tasks", tasks},
            {"algorithms", algorithms},
            {"scenes", scenes},
            {"presets", presets},
            {"stories", std::move(told)},
            {"devices", devices},
            {"peers", {peers_min, peers_max}},
            {"seconds", {seconds_min, seconds_max}}};
}

std::string about_profile(std::string_view text)
{
    constexpr std::size_t about_bytes_max = 160;
    std::string words;
    while (text.starts_with("# ")) {
        const auto line = text.substr(2, text.find('\n') - 2);
        text.remove_prefix(std::min(text.size(), line.size() + 3));
        if (!line.starts_with("SPDX-")) words += (words.empty() ? "" : " ") + std::string{line};
    }
    for (auto end = words.find(". "); end != std::string::npos; end = words.find(". ", end + 1)) {
        const char next = words[end + 2];
        if (next < 'A' || next > 'Z') continue; // "Fig. 6a": not the end of a sentence
        words.resize(end + 1);
        break;
    }
    if (words.size() <= about_bytes_max) return words;
    return words.substr(0, words.rfind(' ', about_bytes_max)) + " ...";
}

Choices all_choices(std::vector<std::string> presets)
{
    Choices choices;
    choices.tasks = {"P1", "T1", "T2", "T3", "T4", "T5", "T6", "T7", "T8", "T9", "T10"};
    choices.algorithms = {"base", "dead-reckoning", "sep", "remote-proxy"};
    choices.scenes.emplace_back(own_scene);
    choices.scenes.insert(choices.scenes.end(), scenes_of_two.begin(), scenes_of_two.end());
    choices.stories = all_stories();
    choices.presets = std::move(presets);
    return choices;
}

nlohmann::ordered_json Choice::json() const
{
    return {{"mode", mode},       {"task", task},     {"algorithm", algorithm},
            {"scene", scene},     {"preset", preset}, {"peers", peers},
            {"seconds", seconds}, {"seed", seed},     {"device", device}};
}

nlohmann::ordered_json Story::json() const
{
    return {{"name", name}, {"title", title}, {"look", look}, {"choice", choice.json()}};
}

base::Result<Choice> choice_of(const nlohmann::ordered_json& request, const Choice& before,
                               const Choices& choices)
{
    Choice choice = before;
    ChoiceReader in{request};
    std::string name;
    in.one_of("story", names_of(choices.stories), name);
    if (!name.empty()) {
        choice = std::ranges::find(choices.stories, name, &Story::name)->choice;
        choice.mode = before.mode;
        choice.loop = before.loop;
    }
    in.one_of("mode", choices.modes, choice.mode);
    in.one_of("task", choices.tasks, choice.task);
    in.one_of("algorithm", choices.algorithms, choice.algorithm);
    in.one_of("scene", choices.scenes, choice.scene);
    in.one_of("preset", choices.presets, choice.preset);
    in.one_of("device", choices.devices, choice.device);
    in.number("peers", choices.peers_min, choices.peers_max, choice.peers);
    in.number("seconds", choices.seconds_min, choices.seconds_max, choice.seconds);
    in.number("seed", 1, seed_max, choice.seed);
    in.truth("loop", choice.loop);
    in.refuse_others();
    if (!in.why().empty()) return base::fail(in.why());
    if (choice.peers > 2 && !is_for_many(choice.task)) {
        return base::fail(fmt::format("task {} is for two peers; with {} choose T7 or T8",
                                      choice.task, choice.peers));
    }
    if (choice.peers > 2 && choice.scene != own_scene) {
        return base::fail(fmt::format("the scene {} is for two peers; with {} leave the scene at "
                                      "{}, that of the task",
                                      choice.scene, choice.peers, own_scene));
    }
    if (choice.mode == "virtual" && choice.seed > virtual_seed_max) {
        return base::fail(
            fmt::format("\"seed\" must be at most {} in virtual time", virtual_seed_max));
    }
    return choice;
}

Start emulator_start(const Choice& choice, const StageFolders& folders)
{
    Start start{.words = {folders.programs + "/hapnet-emulator"},
                .socket = folders.sockets + "/emulator.sock",
                .log = folders.results + "/emulator.log"};
    auto& words = start.words;
    if (choice.peers == 2) {
        words.insert(words.end(), {"--listen-a", "127.0.0.1:0", "--listen-b", "127.0.0.1:0"});
    } else {
        for (int a = 1; a <= choice.peers; ++a) {
            for (int b = a + 1; b <= choice.peers; ++b) {
                words.emplace_back("--link");
                words.push_back(pair_name(a, b) + "=127.0.0.1:0,127.0.0.1:0");
            }
        }
    }
    words.insert(words.end(), {"--keep", held_for, "--keep-in", folders.kept, "--profile",
                               choice.preset, "--seed", std::to_string(choice.seed), "--control",
                               start.socket, "--stats", folders.results + "/emulator.json"});
    return start;
}

base::Result<Places> places_in(std::string_view ready_line, int peers)
{
    Places places;
    std::string_view rest = ready_line;
    while (!rest.empty()) {
        const auto end = rest.find(' ');
        const auto word = rest.substr(0, end);
        rest = end == std::string_view::npos ? "" : rest.substr(end + 1);
        const auto sign = word.find('=');
        if (sign == std::string_view::npos) continue;
        const auto name = word.substr(0, sign);
        const auto value = word.substr(sign + 1);
        const auto comma = value.find(',');
        if (peers == 2 && name == "a") places.emplace("1-2", value);
        if (peers == 2 && name == "b") places.emplace("2-1", value);
        const auto dash = name.find('-');
        if (comma == std::string_view::npos || dash == std::string_view::npos) continue;
        places.emplace(name, value.substr(0, comma));
        places.emplace(fmt::format("{}-{}", name.substr(dash + 1), name.substr(0, dash)),
                       value.substr(comma + 1));
    }
    for (int a = 1; a <= peers; ++a) {
        for (int b = 1; b <= peers; ++b) {
            if (a == b || places.contains(pair_name(a, b))) continue;
            return base::fail(fmt::format("the emulator does not say where peer {} is to send what "
                                          "is for peer {}",
                                          a, b));
        }
    }
    return places;
}

Start lab_start(const Choice& choice, const StageFolders& folders, const Choices& choices)
{
    Start start{.words = {folders.programs + "/hapnet-lab", "play", "--task", choice.task,
                          "--algorithm", choice.algorithm},
                .socket = folders.sockets + "/lab.sock",
                .log = folders.results + "/lab.log"};
    auto& words = start.words;
    int others = choice.peers == 2 ? lab_others_max : 0;
    for (const std::string& other : choices.algorithms) {
        if (other == choice.algorithm || others == 0) continue;
        --others;
        words.insert(words.end(), {"--algorithm", other});
    }
    if (choice.scene != own_scene) {
        words.insert(words.end(), {"--set", "scene=" + choice.scene});
    }
    words.insert(words.end(), {"--profile", choice.preset, "--seed", std::to_string(choice.seed),
                               "--duration", fmt::format("{}s", choice.seconds), "--peers",
                               std::to_string(choice.peers), "--control", start.socket, "--out",
                               folders.results, "--device", device_of(1, choice)});
    return start;
}

std::vector<std::string> lab_peer_sockets(const std::string& socket, int peers)
{
    std::vector<std::string> sockets;
    for (int id = 1; id <= peers; ++id) sockets.push_back(fmt::format("{}.peer-{}", socket, id));
    return sockets;
}

Start peer_start(int id, const Choice& choice, const StageFolders& folders, const Places& places)
{
    base::ensure(id >= 1 && id <= choice.peers);
    const std::string name = fmt::format("peer-{}", id);
    Start start{.words = {folders.programs + "/hapnet-peer", "--id", std::to_string(id)},
                .socket = fmt::format("{}/{}.sock", folders.sockets, name),
                .log = fmt::format("{}/{}.log", folders.results, name)};
    auto& words = start.words;
    if (choice.peers == 2) {
        words.insert(words.end(),
                     {"--listen", "127.0.0.1:0", "--remote", places.at(pair_name(id, 3 - id))});
    } else {
        for (int other = 1; other <= choice.peers; ++other) {
            if (other == id) continue;
            words.emplace_back("--peer");
            words.push_back(fmt::format("{}={}", other, places.at(pair_name(id, other))));
        }
    }
    if (choice.scene != own_scene) words.insert(words.end(), {"--scene", choice.scene});
    words.insert(words.end(), {"--keep",      held_for,
                               "--keep-in",   folders.kept,
                               "--device",    device_of(id, choice),
                               "--task",      choice.task,
                               "--algorithm", choice.algorithm,
                               "--seed",      std::to_string(choice.seed),
                               "--duration",  fmt::format("{}s", choice.seconds),
                               "--control",   start.socket,
                               "--record",    fmt::format("{}/{}.rec", folders.results, name),
                               "--stats",     fmt::format("{}/{}.json", folders.results, name)});
    return start;
}

} // namespace hapnet::web

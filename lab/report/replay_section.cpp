// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/report/section.hpp"
#include "scene/description.hpp"

#include <algorithm>
#include <cmath>
#include <cstdint>
#include <nlohmann/json.hpp>
#include <spdlog/fmt/fmt.h>

namespace hapnet::lab::report {

namespace {

using Json = nlohmann::ordered_json;

std::string base64(const std::vector<std::uint8_t>& bytes)
{
    constexpr std::string_view digits =
        "ABCDEFGHIJKLMNOPQRSTUVWXYZabcdefghijklmnopqrstuvwxyz0123456789+/";
    std::string out;
    for (std::size_t i = 0; i < bytes.size(); i += 3) {
        const std::size_t count = std::min<std::size_t>(3, bytes.size() - i);
        std::uint32_t group = 0;
        for (std::size_t k = 0; k < 3; ++k) group = group << 8U | (k < count ? bytes[i + k] : 0U);
        for (std::size_t k = 0; k < 4; ++k) {
            out += k <= count ? digits[group >> (18U - 6U * k) & 63U] : '=';
        }
    }
    return out;
}

/// A column as 16 bits a value, low byte first, and what one of them is worth; one number when
/// nothing moves.
Json packed(const std::vector<double>& column)
{
    double most = 0.0;
    bool moves = false;
    for (const double value : column) {
        most = std::max(most, std::abs(value));
        moves |= value != column.front();
    }
    if (!moves) return column.front();
    const double step = most / 32767.0;
    std::vector<std::uint8_t> bytes;
    for (const double value : column) {
        const auto count = static_cast<std::int16_t>(std::lround(value / step));
        const auto bits = static_cast<std::uint16_t>(count);
        bytes.push_back(static_cast<std::uint8_t>(bits & 0xffU));
        bytes.push_back(static_cast<std::uint8_t>(bits >> 8U));
    }
    return {{"step", step}, {"data", base64(bytes)}};
}

/// What stands in a scene, in mm.
Json bodies_of(const scene::Description& scene)
{
    Json list = Json::array();
    for (const scene::BodyDescription& body : scene.bodies) {
        const auto at = body.position;
        list.push_back({{"movable", body.movable},
                        {"half", {1e3 * body.half.x, 1e3 * body.half.y, 1e3 * body.half.z}},
                        {"at", {1e3 * at.x(), 1e3 * at.y(), 1e3 * at.z()}}});
    }
    return list;
}

Json packed(const results::Replay& replay)
{
    Json columns;
    base::for_each_field(
        [&](const auto& field, const auto&) {
            if (field.key == "time_s") return; // it runs in equal steps
            std::vector<double> column;
            for (const results::ReplayRow& row : replay.rows) column.push_back(row.*field.member);
            columns[std::string{field.key}] = packed(column);
        },
        replay.rows.front());
    return {{"algorithm", replay.algorithm},     {"task", replay.task},
            {"bodies", bodies_of(replay.scene)}, {"hip_radius", 1e3 * replay.scene.hands.radius_m},
            {"start_s", replay.start_s},         {"step_s", replay.step_s},
            {"count", replay.rows.size()},       {"columns", columns}};
}

/// JSON that can stand inside a script element: nothing in it closes that.
std::string for_script(const Json& json)
{
    std::string out;
    for (const char c : json.dump(-1, ' ', true, Json::error_handler_t::replace)) {
        if (c == '<') {
            out += "\\u003c";
        } else {
            out += c;
        }
    }
    return out;
}

constexpr std::string_view player = R"html(<div class="player" tabindex="0" role="group"
 aria-label="Replay: space plays and stops, arrow keys step, Home and End go to the ends">
<div class="controls">
<label>algorithm <select class="algorithm"></select></label>
<label>task <select class="task"></select></label>
<button type="button" class="play" aria-label="play or stop">▶</button>
<input type="range" class="time" min="0" value="0" step="1" aria-label="time">
<label>speed <select class="speed"><option value="0.1">⅒</option><option value="0.25">¼</option>
<option value="1" selected>1</option><option value="2">2</option><option value="5">5</option>
</select></label>
</div>
<div class="stage">
<figure><canvas class="left" width="900" height="382" role="img"
 aria-label="what L’s computer holds: its cube and its hand"></canvas>
<figcaption>what L’s computer holds</figcaption></figure>
<figure><canvas class="right" width="900" height="382" role="img"
 aria-label="what R’s computer holds: its cube and its hand"></canvas>
<figcaption>what R’s computer holds</figcaption></figure>
</div>
<p class="numbers"><output class="clock"></output> <output class="apart"></output>
<output class="forces"></output></p>
<canvas class="strip" width="1800" height="240" role="img"
 aria-label="x of both cubes over time; click to go there"></canvas>
</div>
<noscript><p>The replay needs JavaScript; everything else on this page does not.</p></noscript>
)html";

} // namespace

std::optional<Section> replay_section(const results::Results& results)
{
    if (results.replays.empty()) return std::nullopt;
    Json replays = Json::array();
    for (const results::Replay& replay : results.replays) replays.push_back(packed(replay));
    return Section{"replay", "Look at it",
                   "<p>Both computers hold a copy of the blue cube. Each picture shows one of "
                   "them, with the hand that is there; the dashed outline is where the other has "
                   "the cube at the same moment. Arrows are forces on the hands.</p>\n" +
                       std::string{player} +
                       fmt::format("<script type='application/json' id='replays'>{}</script>\n",
                                   for_script(replays))};
}

} // namespace hapnet::lab::report

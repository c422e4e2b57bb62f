// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "lab/records/bodies.hpp"

#include "lab/metrics/angle.hpp"
#include "scene/text/text.hpp"

#include <algorithm>
#include <set>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::lab::records {

namespace {

std::optional<scene::Description> scene_of(const record::Record& record)
{
    const auto text = record.config.value("scene_toml", nlohmann::json{});
    if (!text.is_string()) return std::nullopt;
    auto scene = scene::parse_scene(text.get<std::string>(), "scene_toml");
    if (!scene) return std::nullopt;
    return *std::move(scene);
}

std::set<std::uint16_t> numbers_in(const record::Record& record)
{
    std::set<std::uint16_t> numbers;
    for (const record::BodyRow& row : record.bodies) numbers.insert(row.body);
    return numbers;
}

/// Returns the body with that number, as the scene describes it.
RecordedBody described(const std::optional<scene::Description>& scene, std::uint16_t number,
                       bool has_rows)
{
    RecordedBody body{.number = number, .can_turn = has_rows, .has_rows = has_rows};
    if (!scene || number >= scene->bodies.size()) return body;
    const scene::BodyDescription& description = scene->bodies[number];
    body.name = description.name;
    body.can_turn = has_rows && description.turning != scene::Turning::locked;
    return body;
}

std::optional<std::uint16_t> first_movable(const std::optional<scene::Description>& scene)
{
    if (!scene) return std::nullopt;
    const auto body = std::ranges::find_if(scene->bodies, &scene::BodyDescription::movable);
    if (body == scene->bodies.end()) return std::nullopt;
    return static_cast<std::uint16_t>(body - scene->bodies.begin());
}

} // namespace

std::vector<RecordedBody> bodies_shared_in(const record::Record& a, const record::Record& b)
{
    const auto scene = scene_of(a);
    const auto of_b = numbers_in(b);
    std::vector<RecordedBody> bodies;
    for (const std::uint16_t number : numbers_in(a)) {
        if (of_b.contains(number)) bodies.push_back(described(scene, number, true));
    }
    if (!bodies.empty()) return bodies;
    const auto number = first_movable(scene);
    return {number ? described(scene, *number, false) : RecordedBody{}};
}

std::string name_of(const RecordedBody& body)
{
    if (!body.name.empty()) return body.name;
    return body.number ? fmt::format("body {}", *body.number + 1) : "the body";
}

std::string named_in_text(const RecordedBody& body)
{
    return body.name.empty() ? name_of(body) : "the " + body.name;
}

const record::BodyRow* Poses::row_of(const record::TickRow& tick) const
{
    if (!body_.has_rows) return nullptr;
    const auto key = [](const record::BodyRow& row) { return std::pair{row.tick, row.body}; };
    const std::pair wanted{tick.tick, *body_.number};
    const auto row = std::ranges::lower_bound(side_.bodies, wanted, {}, key);
    return row == side_.bodies.end() || key(*row) != wanted ? nullptr : &*row;
}

std::optional<Pose> Poses::at(const record::TickRow& tick) const
{
    if (!body_.has_rows) return Pose{tick.cube};
    const record::BodyRow* const row = row_of(tick);
    if (row == nullptr) return std::nullopt;
    return Pose{row->position, row->orientation};
}

std::uint16_t Poses::owner_at(const record::TickRow& tick) const
{
    const record::BodyRow* const row = row_of(tick);
    return row == nullptr ? std::uint16_t{0} : row->owner;
}

std::optional<Apart> Copies::apart_at(const Moment& moment) const
{
    const auto a = a_.at(*moment.a);
    const auto before = b_.at(*moment.before);
    const auto after = b_.at(*moment.after);
    if (!a || !before || !after) return std::nullopt;
    const Pose b = virtual_time::between(*before, *after, moment.share);
    return Apart{a->position - b.position, metrics::angle_between(a->orientation, b.orientation)};
}

} // namespace hapnet::lab::records

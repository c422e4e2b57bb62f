// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/feed.hpp"

#include "proto/base/clock_pair.hpp"
#include "proto/base/ensure.hpp"

#include <algorithm>
#include <array>
#include <cmath>
#include <iterator>
#include <spdlog/fmt/fmt.h>
#include <utility>

namespace hapnet::web {

namespace {

constexpr std::array peer_figures{"force_n.max", "late_us.max", "missed", "age_ms", "delay_ms.max"};
constexpr std::array way_figures{"dropped_share", "delay_ms.max", "late_us.max", "in_flight"};

template <typename... Values>
void put(std::string& text, fmt::format_string<Values...> form, Values&&... values)
{
    fmt::format_to(std::back_inserter(text), form, std::forward<Values>(values)...);
}

std::string number_text(double value)
{
    return std::isfinite(value) ? fmt::format("{:.6g}", value) : "null";
}

std::string vector_text(const glm::dvec3& v)
{
    return fmt::format("[{:.7g},{:.7g},{:.7g}]", v.x, v.y, v.z);
}

std::string letter_of(std::size_t place)
{
    return {static_cast<char>('a' + static_cast<int>(place % 26))};
}

/// Appends a frame, or `repeated` if it is not new.
void put_frame(std::string& text, const std::string& frame, bool is_new)
{
    if (is_new) {
        text += frame;
        return;
    }
    text.append(frame, 0, frame.rfind('}'));
    text += ",\"repeated\":true}";
}

/// Returns the name prefix of a direction: "1-2.up", or "up" for the only path.
std::string way_name(const std::string& path, const char* way)
{
    return path.empty() ? way : path + "." + way;
}

} // namespace

void Feed::set_peers(std::vector<Source> peers)
{
    if (peers == peers_) return;
    peers_ = std::move(peers);
    newest_.assign(peers_.size(), {});
    tracks_.assign(peers_.size(), {});
    forget();
}

void Feed::take_peer(std::size_t place, PeerFrame frame)
{
    base::ensure(place < peers_.size());
    tracks_[place].add(frame.cube);
    // Counts of frames that arrived since the last live frame are added up.
    auto& newest = newest_[place];
    if (!newest.frame || newest.frame->cube.at != frame.cube.at) ++moves_;
    if (newest.frame && newest.is_new) {
        frame.missed += newest.frame->missed;
        frame.force_max_n = std::max(frame.force_max_n, newest.frame->force_max_n);
        frame.late_max_us = std::max(frame.late_max_us, newest.frame->late_max_us);
    }
    newest = {std::move(frame), true};
}

void Feed::take_emulator(EmulatorFrame frame)
{
    known_paths_.clear();
    for (const auto& path : frame.paths) known_paths_.push_back(path.name);
    if (!emulator_.frame || emulator_.frame->at != frame.at) ++moves_;
    emulator_ = {std::move(frame), true};
}

void Feed::lose_peer(std::size_t place)
{
    base::ensure(place < peers_.size());
    newest_[place] = {};
    tracks_[place].clear();
}

void Feed::forget() { history_.clear(); }

std::optional<std::uint64_t> Feed::generation() const
{
    if (!emulator_.frame) return std::nullopt;
    return emulator_.frame->generation;
}

std::optional<double> Feed::elapsed_s() const
{
    if (!emulator_.frame) return std::nullopt;
    return emulator_.frame->elapsed_s;
}

const PeerFrame::Heard* Feed::heard_by(std::size_t place, std::uint16_t from) const
{
    if (!newest_[place].frame) return nullptr;
    const auto& heard = newest_[place].frame->heard;
    const auto found = std::ranges::find(heard, from, &PeerFrame::Heard::from);
    return found == heard.end() ? nullptr : &*found;
}

bool Feed::share_clock(std::size_t a, std::size_t b) const
{
    if (peers_[a].boot_id.empty() || peers_[a].boot_id != peers_[b].boot_id) return false;
    const auto* heard = heard_by(a, peers_[b].id);
    if (heard == nullptr || std::isnan(heard->offset_ms)) return true;
    const double uncertainty_ms = std::isnan(heard->uncertainty_ms) ? 0.0 : heard->uncertainty_ms;
    return !base::are_two_clocks(base::from_seconds(heard->offset_ms * 1e-3),
                                 base::from_seconds(uncertainty_ms * 1e-3));
}

Feed::Pair Feed::pair_of(std::size_t a, std::size_t b) const
{
    Pair pair{.a = a, .b = b, .apart = {}};
    if (!newest_[a].frame || !newest_[b].frame) return pair;
    pair.force_apart_n = std::abs(newest_[a].frame->force_n - newest_[b].frame->force_n);
    double ahead_ms = 0.0;
    if (!share_clock(a, b)) {
        const auto* heard = heard_by(a, peers_[b].id);
        if (heard == nullptr || std::isnan(heard->offset_ms)) return pair;
        ahead_ms = heard->offset_ms;
        pair.uncertainty_ms = heard->uncertainty_ms;
    } else {
        pair.uncertainty_ms = 0.0;
    }
    pair.apart = apart(tracks_[a], tracks_[b], base::from_seconds(ahead_ms * 1e-3));
    return pair;
}

std::vector<Feed::Pair> Feed::pairs() const
{
    std::vector<Pair> all;
    for (std::size_t a = 0; a < peers_.size(); ++a) {
        for (std::size_t b = a + 1; b < peers_.size(); ++b) all.push_back(pair_of(a, b));
    }
    return all;
}

std::optional<std::string> Feed::next(double at_s, base::TimePoint now)
{
    if (is_empty()) return std::nullopt;
    const auto paired = pairs();
    std::string text = text_of(paired, at_s, now, /*is_again*/ false);
    note_figures(paired);
    note_history(at_s, paired);
    for (auto& one : newest_) one.is_new = false;
    emulator_.is_new = false;
    return text;
}

std::optional<std::string> Feed::newest(double at_s, base::TimePoint now) const
{
    if (is_empty()) return std::nullopt;
    return text_of(pairs(), at_s, now, /*is_again*/ true);
}

bool Feed::is_empty() const
{
    const bool has_peer =
        std::ranges::any_of(newest_, [](const auto& one) { return one.frame.has_value(); });
    return !has_peer && !emulator_.frame;
}

std::string Feed::text_of(const std::vector<Pair>& pairs, double at_s, base::TimePoint now,
                          bool is_again) const
{
    std::string text;
    put(text, ",\"at_s\":{:.4f},\"at_ns\":{},\"peers\":[", at_s, now.time_since_epoch().count());
    for (std::size_t i = 0; i < newest_.size(); ++i) {
        if (i > 0) text += ',';
        if (newest_[i].frame) {
            put_frame(text, newest_[i].frame->text, newest_[i].is_new && !is_again);
        } else {
            text += "null";
        }
    }
    text += "],\"pairs\":[";
    for (const Pair& pair : pairs) {
        put(text, "{}{{\"a\":{},\"b\":{}", &pair == &pairs.front() ? "" : ",", peers_[pair.a].id,
            peers_[pair.b].id);
        if (pair.apart) {
            put(text,
                ",\"at_ns\":{},\"apart_mm\":{},\"distance_mm\":{},\"cube_a\":{},\"cube_b\":{}",
                pair.apart->at.time_since_epoch().count(),
                number_text(pair.apart->along_x_m() * 1e3),
                number_text(pair.apart->distance_m() * 1e3), vector_text(pair.apart->a),
                vector_text(pair.apart->b));
        } else {
            text += ",\"at_ns\":null,\"apart_mm\":null,\"distance_mm\":null,\"cube_a\":null,"
                    "\"cube_b\":null";
        }
        put(text, ",\"uncertainty_ms\":{},\"force_apart_n\":{}}}", number_text(pair.uncertainty_ms),
            number_text(pair.force_apart_n));
    }
    text += "],\"emulator\":";
    if (emulator_.frame) {
        put_frame(text, emulator_.frame->text, emulator_.is_new && !is_again);
    } else {
        text += "null";
    }
    text += '}';
    return text;
}

void Feed::note_figures(const std::vector<Pair>& pairs)
{
    figures_.clear();
    const auto note = [this](const std::string& name, double value) {
        if (!std::isfinite(value)) return;
        const auto [place, is_first] = figures_.try_emplace(name, value);
        if (!is_first) place->second = std::max(place->second, value);
    };
    for (const Pair& pair : pairs) {
        if (!pair.apart) continue;
        note("apart_mm", pair.apart->along_x_m() * 1e3);
        note("distance_mm", pair.apart->distance_m() * 1e3);
    }
    for (std::size_t i = 0; i < newest_.size(); ++i) {
        if (!newest_[i].frame) continue;
        const PeerFrame& frame = *newest_[i].frame;
        const std::string letter = letter_of(i) + ".";
        note(letter + "force_n.max", frame.force_max_n);
        note(letter + "late_us.max", frame.late_max_us);
        note(letter + "missed", newest_[i].is_new ? frame.missed : 0.0);
        for (const auto& heard : frame.heard) {
            note(letter + "age_ms", heard.age_ms);
            note(letter + "delay_ms.max", heard.delay_max_ms);
        }
    }
    if (!emulator_.frame) return;
    for (const auto& path : emulator_.frame->paths) {
        note_way(way_name(path.name, "up"), path.up);
        note_way(way_name(path.name, "down"), path.down);
    }
}

void Feed::note_way(const std::string& name, const EmulatorFrame::Way& way)
{
    const auto note = [&](const char* figure, double value) {
        if (std::isfinite(value)) figures_.insert_or_assign(name + "." + figure, value);
    };
    note("dropped_share", way.dropped_share());
    note("delay_ms.max", way.delay_max_ms);
    note("late_us.max", way.late_max_us);
    note("in_flight", way.in_flight);
}

std::vector<std::string> Feed::names() const
{
    std::vector<std::string> all{"apart_mm", "distance_mm"};
    for (std::size_t i = 0; i < peers_.size(); ++i) {
        for (const char* figure : peer_figures) all.push_back(letter_of(i) + "." + figure);
    }
    for (const std::string& path : paths()) {
        for (const char* way : {"up", "down"}) {
            for (const char* figure : way_figures) {
                all.push_back(way_name(path, way) + "." + figure);
            }
        }
    }
    return all;
}

void Feed::note_history(double at_s, const std::vector<Pair>& pairs)
{
    std::vector<std::string> columns{"at_s"};
    std::vector<double> row{at_s};
    const auto note = [&](std::string column, double value) {
        columns.push_back(std::move(column));
        row.push_back(value);
    };
    for (const Pair& pair : pairs) {
        note(fmt::format("apart_mm:{}-{}", peers_[pair.a].id, peers_[pair.b].id),
             pair.apart ? pair.apart->along_x_m() * 1e3 : unknown);
    }
    for (std::size_t i = 0; i < newest_.size(); ++i) {
        const PeerFrame* frame = newest_[i].frame ? &*newest_[i].frame : nullptr;
        const auto* heard =
            frame != nullptr && !frame->heard.empty() ? &frame->heard.front() : nullptr;
        const auto id = peers_[i].id;
        note(fmt::format("force_n:{}", id), frame != nullptr ? frame->force_max_n : unknown);
        note(fmt::format("peer_late_us:{}", id), frame != nullptr ? frame->late_max_us : unknown);
        note(fmt::format("heard_delay_ms:{}", id),
             heard != nullptr ? heard->delay_mean_ms : unknown);
        note(fmt::format("heard_lost:{}", id), heard != nullptr ? heard->lost : unknown);
    }
    // The columns stay the same while the emulator is away for a moment.
    for (std::size_t i = 0; i < known_paths_.size(); ++i) {
        const auto path = emulator_.frame ? emulator_.frame->paths[i]
                                          : EmulatorFrame::Path{known_paths_[i], {}, {}};
        note("up.delay_ms:" + path.name, path.up.delay_mean_ms);
        note("down.delay_ms:" + path.name, path.down.delay_mean_ms);
        note("up.dropped:" + path.name, path.up.dropped_share());
        note("down.dropped:" + path.name, path.down.dropped_share());
        note("up.late_us:" + path.name, path.up.late_max_us);
        note("down.late_us:" + path.name, path.down.late_max_us);
    }
    history_.set_columns(std::move(columns));
    history_.add(row);
}

} // namespace hapnet::web

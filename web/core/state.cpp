// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "web/core/state.hpp"

#include <algorithm>
#include <array>

namespace hapnet::web {

namespace {

using Json = nlohmann::ordered_json;

/// Returns the last part of a path. A page has no use for the rest.
std::string file_of(const std::string& path) { return path.substr(path.rfind('/') + 1); }

Json text_or_null(const std::string& text) { return text.empty() ? Json(nullptr) : Json(text); }

/// Returns the member of a reply; null where there is none.
Json member(const Json& reply, const char* key)
{
    const auto found = reply.is_object() ? reply.find(key) : reply.end();
    return found == reply.end() ? Json(nullptr) : *found;
}

Json emulator_json(const EmulatorState& emulator)
{
    Json json{{"attached", emulator.is_attached}, {"socket", file_of(emulator.socket)}};
    for (const char* key : {"generation", "conditions", "live", "timeline"}) {
        json[key] = member(emulator.shown, key);
    }
    json["paths"] = emulator.paths;
    json["error"] = text_or_null(emulator.error);
    return json;
}

/// Returns the place of a scene in the list of seen scenes. A new scene is appended.
Json place_of(const Json& scene, Json& scenes)
{
    if (!scene.is_object()) return nullptr;
    for (std::size_t i = 0; i < scenes.size(); ++i) {
        if (member(scenes[i], "hash") == member(scene, "hash")) return i;
    }
    scenes.push_back(scene);
    return scenes.size() - 1;
}

Json peer_json(const PeerState& peer, std::size_t place, Json& scenes)
{
    Json json{{"id", peer.id()},
              {"letter", capital_letter(place)},
              {"attached", peer.is_attached},
              {"socket", file_of(peer.socket)},
              {"scene", place_of(peer.scene, scenes)}};
    for (const char* key :
         {"task", "algorithm", "device", "state", "says", "phase", "session", "seed", "duration_s",
          "elapsed_s", "tick_rate_hz", "governor", "fault", "boot_id"}) {
        json[key] = member(peer.shown, key);
    }
    json["clock"] = peer.shares_clock ? "same" : "offset";
    json["error"] = text_or_null(peer.error);
    return json;
}

} // namespace

std::string capital_letter(std::size_t place)
{
    return {static_cast<char>('A' + static_cast<int>(place % 26))};
}

std::uint16_t PeerState::id() const
{
    const Json id = member(shown, "peer_id");
    return id.is_number_unsigned() && id <= 65535 ? id.get<std::uint16_t>() : std::uint16_t{0};
}

bool PeerState::takes_hand() const { return member(shown, "takes_hand") == true; }

std::string PeerState::boot_id() const
{
    const Json boot_id = member(shown, "boot_id");
    return boot_id.is_string() ? boot_id.get<std::string>() : "";
}

std::string name_of_peer(const std::vector<PeerState>& peers, std::size_t place)
{
    const bool are_known =
        std::ranges::none_of(peers, [](const PeerState& peer) { return peer.id() == 0; });
    return are_known ? capital_letter(place) : "peer " + std::to_string(peers.at(place).id());
}

nlohmann::ordered_json state_json(double at_s, const EmulatorState& emulator,
                                  const std::vector<PeerState>& peers,
                                  const nlohmann::ordered_json& others)
{
    Json scenes = Json::array();
    Json all = Json::array();
    for (std::size_t i = 0; i < peers.size(); ++i) {
        all.push_back(peer_json(peers[i], i, scenes));
    }
    Json json{{"mode", "live"},
              {"at_s", at_s},
              {"emulator", emulator_json(emulator)},
              {"peers", std::move(all)},
              {"scenes", std::move(scenes)}};
    json.update(others);
    return json;
}

nlohmann::ordered_json help_for(const EmulatorState& emulator, const std::vector<PeerState>& peers,
                                bool has_stage)
{
    const bool has_peer =
        std::ranges::any_of(peers, [](const PeerState& peer) { return peer.is_attached; });
    if (emulator.is_attached || has_peer) return nullptr;
    if (has_stage) return "nothing runs: press start";
    if (emulator.socket.empty() && peers.empty()) {
        return "nothing is attached: run hapnet-web --stage, or name the sockets: hapnet-web "
               "--emulator SOCKET --peer SOCKET --peer SOCKET";
    }
    return "nothing answers on the sockets: start hapnet-emulator and hapnet-peer with --control";
}

std::string why_nothing_is_held(const EmulatorState& emulator, const std::vector<PeerState>& peers)
{
    if (member(member(emulator.shown, "pace"), "read_only") == true) {
        return "what is shown comes from records: they are saved already";
    }
    if (emulator.is_virtual()) {
        return "virtual time plays again from its seed: save it as an experiment";
    }
    bool is_any = false;
    bool are_all = true;
    const auto look_at = [&](bool is_attached, const Json& shown) {
        if (!is_attached || !shown.is_object()) return;
        is_any = true;
        are_all = are_all && member(shown, "held_s").is_number();
    };
    look_at(emulator.is_attached, emulator.shown);
    for (const PeerState& peer : peers) look_at(peer.is_attached, peer.shown);
    if (!is_any) return "nothing is attached";
    return are_all ? "" : "start the daemons with --keep 20s --keep-in DIR";
}

} // namespace hapnet::web

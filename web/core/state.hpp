// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstdint>
#include <nlohmann/json.hpp>
#include <string>
#include <vector>

namespace hapnet::web {

/// The known state of an emulator.
struct EmulatorState {
    std::string socket; // empty: no emulator is wanted
    bool is_attached = false;
    nlohmann::ordered_json shown = nullptr; // last reply to the request `show`
    std::vector<std::string> paths{};
    std::string error{};

    /// True if the emulator runs in virtual time.
    [[nodiscard]] bool is_virtual() const { return shown.is_object() && shown.contains("pace"); }
};

/// The known state of a peer.
struct PeerState {
    std::string socket;
    bool is_attached = false;
    nlohmann::ordered_json shown = nullptr; // last reply to the request `show`
    nlohmann::ordered_json scene = nullptr; // last reply to the request `scene`
    std::string error{};
    bool shares_clock = false; // has the same clock as the first peer

    /// Returns the peer's id; 0: not known yet.
    [[nodiscard]] std::uint16_t id() const;
    [[nodiscard]] std::string boot_id() const;
    /// True if pages may move the peer's hand.
    [[nodiscard]] bool takes_hand() const;
};

/// Returns the letter of a place: "A" for the first.
[[nodiscard]] std::string capital_letter(std::size_t place);

/// Returns the name of the peer at that place for people: its letter, where "A" is the lowest id.
/// While some ids are unknown, so that their order is unknown too, the name is "peer 2" and so on.
[[nodiscard]] std::string name_of_peer(const std::vector<PeerState>& peers, std::size_t place);

/// Returns the state for pages: docs/formats/live.md. `peers` are in the order of the live frames.
/// The members of `others` are appended unchanged.
[[nodiscard]] nlohmann::ordered_json state_json(double at_s, const EmulatorState& emulator,
                                                const std::vector<PeerState>& peers,
                                                const nlohmann::ordered_json& others);

/// Returns advice for a person who sees nothing yet; null while something is attached.
[[nodiscard]] nlohmann::ordered_json help_for(const EmulatorState& emulator,
                                              const std::vector<PeerState>& peers, bool has_stage);

/// Returns the reason why the attached daemons cannot save their last seconds; "" if they can.
[[nodiscard]] std::string why_nothing_is_held(const EmulatorState& emulator,
                                              const std::vector<PeerState>& peers);

} // namespace hapnet::web

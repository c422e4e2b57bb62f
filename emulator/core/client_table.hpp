// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/ensure.hpp"
#include "proto/base/time.hpp"

#include <cstddef>
#include <optional>
#include <utility>
#include <vector>

namespace hapnet::emulator {

/// The clients of one server, by their source addresses. Each client has a place, which is free
/// again when the client is forgotten.
template <typename Address>
class ClientTable {
public:
    ClientTable(std::size_t clients_max, base::Duration idle) : idle_{idle}, places_(clients_max) {}

    /// Returns the place of a known client, and notes that it sent at `at`.
    [[nodiscard]] std::optional<std::size_t> find(const Address& address, base::TimePoint at)
    {
        for (std::size_t i = 0; i < places_.size(); ++i) { // begins with the one found last
            const std::size_t place = (last_ + i) % places_.size();
            auto& client = places_[place];
            if (!client || client->address != address) continue;
            last_ = place;
            client->heard = at;
            return place;
        }
        return std::nullopt;
    }

    /// Adds an unknown client and returns its place; nullopt: no place is free.
    [[nodiscard]] std::optional<std::size_t> add(const Address& address, base::TimePoint at)
    {
        for (std::size_t place = 0; place < places_.size(); ++place) {
            if (places_[place]) continue;
            places_[place].emplace(Client{address, at});
            return place;
        }
        return std::nullopt;
    }

    [[nodiscard]] const Address& address(std::size_t place) const { return at(place).address; }

    /// Returns the time at which the client will have been silent long enough to be forgotten.
    [[nodiscard]] base::TimePoint idle_at(std::size_t place) const
    {
        return at(place).heard + idle_;
    }

    void forget(std::size_t place)
    {
        base::ensure(places_.at(place).has_value());
        places_[place].reset();
    }

    [[nodiscard]] bool is_used(std::size_t place) const { return places_[place].has_value(); }
    [[nodiscard]] std::size_t size_max() const { return places_.size(); }

private:
    struct Client {
        Address address;
        base::TimePoint heard{};
    };
    [[nodiscard]] const Client& at(std::size_t place) const
    {
        base::ensure(places_.at(place).has_value());
        return *places_[place];
    }

    base::Duration idle_;
    std::vector<std::optional<Client>> places_;
    std::size_t last_ = 0;
};

} // namespace hapnet::emulator

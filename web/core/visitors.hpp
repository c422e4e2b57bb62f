// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include <cstddef>
#include <cstdint>
#include <functional>
#include <list>
#include <memory>
#include <utility>

namespace hapnet::web {

/// A connection that counts toward the limit.
struct Visitor {
    std::function<bool()> is_idle;
    std::function<void()> close; // called to make room for another visitor
};

class Visit;

/// All connections except those of viewers. Viewers have shown the token and have a limit of their
/// own.
class Visitors {
public:
    explicit Visitors(std::size_t most) : most_{most} {}

    /// Admits a visitor. A visitor beyond the limit replaces the oldest idle one, or the oldest one
    /// if none is idle, so that idle connections keep no browser out.
    [[nodiscard]] Visit admit(Visitor visitor);
    /// Closes all connections.
    void close_all();

    [[nodiscard]] std::size_t count() const { return all_->size(); }

private:
    friend class Visit;
    struct Entry {
        std::uint64_t id = 0;
        Visitor visitor;
    };
    using Entries = std::list<Entry>; // in the order of their arrival

    void make_room();

    std::size_t most_;
    std::shared_ptr<Entries> all_ = std::make_shared<Entries>();
    std::uint64_t next_id_ = 1;
};

/// A visitor's place, valid as long as this object lives. It may outlive the visitors: connections
/// end last.
class Visit {
public:
    Visit(Visit&&) noexcept = default;
    Visit& operator=(Visit&&) = delete;
    Visit(const Visit&) = delete;
    Visit& operator=(const Visit&) = delete;
    ~Visit()
    {
        if (const auto all = all_.lock())
            all->remove_if([this](const auto& entry) { return entry.id == id_; });
    }

private:
    friend class Visitors;
    Visit(std::weak_ptr<Visitors::Entries> all, std::uint64_t id) : all_{std::move(all)}, id_{id} {}

    std::weak_ptr<Visitors::Entries> all_;
    std::uint64_t id_;
};

} // namespace hapnet::web

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "web/core/events.hpp"
#include "web/core/trap.hpp"
#include "web/daemons.hpp"
#include "web/hand_desk.hpp"
#include "web/metrics_page.hpp"
#include "web/reply.hpp"
#include "web/results.hpp"
#include "web/saving.hpp"
#include "web/stage.hpp"

#include <cstdint>
#include <functional>
#include <map>
#include <memory>
#include <optional>
#include <string>
#include <string_view>
#include <utility>
#include <vector>

namespace hapnet::web {

/// A connected page: the functions that send to it. All pages share the texts.
struct Viewer {
    using Text = std::shared_ptr<const std::string>;
    std::function<void(Text)> tell;
    /// Sends a live frame without its beginning, which holds the page's own numbers.
    std::function<void(const std::string& body)> frame;
};

using Viewers = std::map<std::uint64_t, Viewer>;

/// A place among the viewers, valid as long as this object lives. It may outlive the viewers:
/// connections end last.
class Membership {
public:
    Membership(std::weak_ptr<Viewers> viewers, std::uint64_t id)
        : viewers_{std::move(viewers)}, id_{id}
    {}
    ~Membership()
    {
        if (const auto viewers = viewers_.lock()) viewers->erase(id_);
    }
    Membership(Membership&& other) noexcept
        : viewers_{std::exchange(other.viewers_, {})}, id_{other.id_}
    {}
    /// Returns the number of the page.
    [[nodiscard]] std::uint64_t id() const { return id_; }
    Membership& operator=(Membership&&) = delete;
    Membership(const Membership&) = delete;
    Membership& operator=(const Membership&) = delete;

private:
    std::weak_ptr<Viewers> viewers_;
    std::uint64_t id_;
};

/// Connects daemons, stage and pages: passes requests on, and reports every change to all pages. It
/// knows nothing of HTTP.
class Hub {
public:
    static constexpr base::Duration frame_every{std::chrono::microseconds{16'667}};
    static constexpr std::size_t viewers_max = 8;

    explicit Hub(boost::asio::io_context& io);

    /// Attaches to running programs. An empty path means no such program.
    void attach(const std::string& emulator, const std::vector<std::string>& peers);
    /// Offers a stage to the pages.
    void offer(Stage::Setup setup, bool begins, bool is_virtual);
    /// Attaches to a session in virtual time. The sockets of its peers are beside its own.
    void attach_lab(const std::string& socket);

    /// Call it at intervals of frame_every.
    void tick(base::TimePoint now);

    /// Adds a viewer and sends it the state so far. nullopt: there are too many viewers.
    [[nodiscard]] std::optional<Membership> join(Viewer viewer);
    [[nodiscard]] bool is_full() const { return viewers_->size() >= viewers_max; }

    /// Handles a page's message that moves or releases the hand, if pages may move the hand of some
    /// peer.
    void hand(std::uint64_t page, const HandMessage& message);

    /// Answers a request that the gate has admitted. `path` has no query.
    void answer(std::string_view path, const std::string& body, const OnReply& on_reply);

private:
    using Json = nlohmann::ordered_json;

    [[nodiscard]] double at_s() const;
    void tell_frame(base::TimePoint now);
    void tell_reset();
    [[nodiscard]] Json state() const;
    void note(const std::string& kind, const std::string& text);
    void note(Event event);
    void tell_all(const Viewer::Text& text);
    void tell_state(base::TimePoint now);
    void step_trap(base::TimePoint now);

    void answer_emulator(const Json& request, const OnReply& on_reply);
    void answer_stage(const Json& request, const OnReply& on_reply);
    void answer_trap(const Json& request, const OnReply& on_reply);
    void answer_pace(const Json& request, const OnReply& on_reply);
    void on_pace(const Json& reply, const OnReply& on_reply);
    void answer_mark(const Json& request, const OnReply& on_reply);
    void answer_keep(const Json& request, const OnReply& on_reply);
    void save(const std::string& name, base::Duration last, Saving::OnSaved on_saved);
    [[nodiscard]] std::string free_name(const std::string& stem);

    boost::asio::io_context& io_;
    base::TimePoint begun_;
    Daemons daemons_;
    Trap trap_;
    Events events_;
    std::unique_ptr<Stage> stage_;
    std::shared_ptr<Viewers> viewers_ = std::make_shared<Viewers>();
    std::uint64_t next_viewer_ = 1;
    bool has_news_ = true; // the state has changed since it was sent
    std::optional<base::TimePoint> next_state_;
    std::optional<Results> results_;
    Saving saving_;
    std::uint64_t moves_told_ = 0; // last value of feed.moves() that was sent; for virtual time
    double at_s_told_ = 0.0;
    int saved_ = 0; // number in the names of saved files
    HandDesk hand_;
    MetricsPage metrics_;
};

} // namespace hapnet::web

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#pragma once

#include "proto/base/time.hpp"
#include "web/core/events.hpp"
#include "web/core/feed.hpp"
#include "web/core/state.hpp"
#include "web/core/trap.hpp"
#include "web/daemon.hpp"
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

/// A page that looks: what is sent to it. The texts are shared by all pages.
struct Viewer {
    using Text = std::shared_ptr<const std::string>;
    std::function<void(Text)> tell;
    /// A live frame without its beginning, which has the page's own numbers.
    std::function<void(const std::string& body)> frame;
};

using Viewers = std::map<std::uint64_t, Viewer>;

/// A place among the viewers, as long as it lives. It may outlive them: connections end last.
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
    Membership& operator=(Membership&&) = delete;
    Membership(const Membership&) = delete;
    Membership& operator=(const Membership&) = delete;

private:
    std::weak_ptr<Viewers> viewers_;
    std::uint64_t id_;
};

/// Between daemons, stage and pages: joins frames, passes requests on, tells everybody what has
/// changed. Knows nothing of HTTP.
class Hub {
public:
    static constexpr base::Duration frame_every{std::chrono::microseconds{16'667}};
    static constexpr std::size_t viewers_max = 8;

    explicit Hub(boost::asio::io_context& io);

    /// What runs already; an empty path: none.
    void attach(const std::string& emulator, const std::vector<std::string>& peers);
    /// The stage that pages may use.
    void offer(Stage::Setup setup, bool begins, bool is_virtual);
    /// A session in virtual time, whose peers have their sockets beside it.
    void attach_lab(const std::string& socket);

    /// Call it every frame_every.
    void tick(base::TimePoint now);

    /// nullopt: too many look already. Tells it what has been so far.
    [[nodiscard]] std::optional<Membership> join(Viewer viewer);
    [[nodiscard]] bool is_full() const { return viewers_->size() >= viewers_max; }

    /// Of a request that the gate has let in. `path` is without query.
    void answer(std::string_view path, const std::string& body, const OnReply& on_reply);

private:
    using Json = nlohmann::ordered_json;

    struct PeerDaemon {
        std::unique_ptr<Daemon> daemon;
        PeerState state;
        std::size_t place = 0; // in the feed
    };

    [[nodiscard]] double at_s() const;
    /// Whether what is attached plays in virtual time.
    [[nodiscard]] bool is_virtual() const;
    void tell_frame(base::TimePoint now);
    [[nodiscard]] Json state() const;
    void note(const std::string& kind, const std::string& text);
    void note(Event event);
    void tell_all(const Viewer::Text& text);
    void tell_state(base::TimePoint now);
    void step_trap(base::TimePoint now);

    void set_daemons(const std::string& emulator, const std::vector<std::string>& peers);
    void set_emulator(const std::string& path);
    void add_peer(const std::string& path);
    void on_emulator_frame(std::string_view line);
    void on_peer_frame(PeerDaemon& peer, std::string_view line);
    void ask_emulator_to_show();
    void ask_peer_to_show(const std::shared_ptr<PeerDaemon>& peer);
    void ask_for_scene(const std::shared_ptr<PeerDaemon>& peer);
    void order_peers();

    void answer_emulator(const Json& request, const OnReply& on_reply);
    void answer_stage(const Json& request, const OnReply& on_reply);
    void answer_trap(const Json& request, const OnReply& on_reply);
    void answer_pace(const Json& request, const OnReply& on_reply);
    void on_pace(const Json& reply, const OnReply& on_reply);
    void answer_mark(const Json& request, const OnReply& on_reply);
    void answer_keep(const Json& request, const OnReply& on_reply);
    [[nodiscard]] std::vector<Daemon*> attached_peers() const;
    [[nodiscard]] Daemon* attached_emulator() const; // null: it is not
    [[nodiscard]] std::vector<PeerState> peer_states() const;
    void save(const std::string& name, base::Duration last, Saving::OnSaved on_saved);
    [[nodiscard]] std::string free_name(const std::string& stem);

    boost::asio::io_context& io_;
    base::TimePoint begun_;
    Feed feed_;
    Trap trap_;
    Events events_;
    std::unique_ptr<Stage> stage_;
    std::unique_ptr<Daemon> emulator_;
    EmulatorState emulator_state_;
    std::uint64_t own_generation_ = 0; // that a request of a page has made
    std::uint64_t shown_generation_ = 0;
    bool is_showing_ = false;
    std::vector<std::shared_ptr<PeerDaemon>> peers_; // in the order of the feed
    std::shared_ptr<Viewers> viewers_ = std::make_shared<Viewers>();
    std::uint64_t next_viewer_ = 1;
    bool has_news_ = true; // of the state
    std::optional<base::TimePoint> next_state_;
    std::optional<base::TimePoint> next_look_; // at what daemons say of themselves
    std::optional<Results> results_;
    Saving saving_;
    std::uint64_t moves_told_ = 0; // of the feed, in virtual time
    double at_s_told_ = 0.0;
    bool finds_lab_peers_ = false; // --lab: once it says how many there are
    int saved_ = 0;                // for names
    MetricsPage metrics_;
};

} // namespace hapnet::web

// SPDX-FileCopyrightText: 2026 The Hapnet authors
// SPDX-License-Identifier: MIT
#include "emulator/control_desk.hpp"

#include "emulator/control/reply.hpp"
#include "emulator/control/request.hpp"
#include "proto/net/clock.hpp"
#include "proto/net/wait.hpp"

#include <utility>
#include <vector>

namespace hapnet::emulator {

namespace {

constexpr control::Server::Limits limits{.line_bytes = request_bytes_max};

} // namespace

ControlDesk::ControlDesk(Setup setup) : setup_{std::move(setup)}
{
    Emulation& emulation = setup_.emulation;
    emulation.work = [this](const control::Step& step) { turns_.run(step); };
    if (setup_.files) {
        folder_ = std::make_unique<net::Folder>(*setup_.files);
        emulation.folder = [this](const std::string& name) { return folder_->text_of(name); };
    }
    if (setup_.socket) {
        subject_ = subject_of(emulation);
        server_ = std::make_unique<control::Server>(*setup_.socket, limits);
    }
    if (server_ || setup_.reload || setup_.look) thread_ = std::thread{[this] { run(); }};
}

ControlDesk::~ControlDesk() { close(); }

void ControlDesk::begin()
{
    if (!has_begun_.exchange(true)) wake_.signal();
}

void ControlDesk::reload()
{
    wants_reload_.store(true);
    wake_.signal();
}

void ControlDesk::close()
{
    is_closing_.store(true);
    turns_.close();
    wake_.signal();
    if (thread_.joinable()) thread_.join();
}

void ControlDesk::run()
{
    while (!has_begun_.load() && !is_closing_.load()) wake_.wait();
    std::vector<int> descriptors{wake_.descriptor()};
    if (server_) descriptors.push_back(server_->descriptor());
    const control::DoWork& work = setup_.emulation.work;
    std::optional<base::TimePoint> next_look;
    if (setup_.look) next_look = net::monotonic_now();
    try {
        while (!is_closing_.load()) {
            auto deadline = next_look;
            if (server_) deadline = base::earlier(deadline, server_->next_deadline());
            net::wait_readable(descriptors, deadline);
            wake_.clear();
            const auto now = net::monotonic_now();
            if (server_) server_->serve(subject_, now);
            if (wants_reload_.exchange(false) && setup_.reload) setup_.reload(setup_.emulation);
            if (base::is_due(next_look, now)) next_look = setup_.look(now, work);
        }
    } catch (const control::LoopHasEnded&) {
        // The run is over, so nothing more has to be reported.
    }
}

} // namespace hapnet::emulator

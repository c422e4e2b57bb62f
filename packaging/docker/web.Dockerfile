# SPDX-FileCopyrightText: 2026 The Hapnet authors
# SPDX-License-Identifier: MIT
#
# The live page. It listens on loopback, so it shares the host's network; the control sockets of the
# daemons lie in a folder that is passed in.
#   scripts/package.sh --out packages
#   docker build -f packaging/docker/web.Dockerfile -t hapnet-web .
#   docker run --rm --network host -v SOCKETS:/sockets hapnet-web --emulator /sockets/emulator.sock
ARG BASE=debian:bookworm-slim
FROM ${BASE}
COPY packages/*.deb /packages/
RUN apt-get update \
    && apt-get install -y --no-install-recommends /packages/hapnet-web_*.deb \
    && rm -rf /packages /var/lib/apt/lists/*
USER nobody
ENTRYPOINT ["hapnet-web"]

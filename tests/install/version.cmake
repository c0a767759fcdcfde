# SPDX-License-Identifier: GPL-2.0-or-later
# Fails unless CITATION.cff and the newest entry of CHANGELOG.md in SOURCE have the version VERSION.
file(STRINGS ${SOURCE}/CITATION.cff citation REGEX "^version: ")
if(NOT citation STREQUAL "version: ${VERSION}")
  message(FATAL_ERROR "CITATION.cff has '${citation}'; the project's version is ${VERSION}")
endif()
file(STRINGS ${SOURCE}/CHANGELOG.md entries REGEX "^## \\[[0-9]")
list(GET entries 0 newest)
if(NOT newest MATCHES "^## \\[${VERSION}\\] - ")
  message(FATAL_ERROR "The newest entry of CHANGELOG.md is '${newest}'; the project's version is ${VERSION}")
endif()

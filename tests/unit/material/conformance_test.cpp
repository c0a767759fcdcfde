// SPDX-License-Identifier: GPL-2.0-or-later
// Every law of this library, and one written point by point, does what every law must do
// (testing/material_conformance.h), with every example that it gives.

#include "furrow/testing/material_conformance.h"

#include "plain_elastic.h"

namespace furrow::conformance_test {
namespace {

INSTANTIATE_TEST_SUITE_P(Laws, MaterialConformance,
                         ::testing::ValuesIn(conformance_cases(material_models())),
                         conformance_case_name);

INSTANTIATE_TEST_SUITE_P(PointwiseLaws, MaterialConformance,
                         ::testing::ValuesIn(conformance_cases({PlainElastic::model()})),
                         conformance_case_name);

}  // namespace
}  // namespace furrow::conformance_test

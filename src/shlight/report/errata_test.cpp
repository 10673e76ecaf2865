#include "shlight/report/errata.h"

#include <gtest/gtest.h>

#include <algorithm>
#include <cmath>
#include <numbers>
#include <set>

namespace shlight {
namespace {

std::vector<Erratum> all_errata() {
  std::vector<Erratum> all = harmonic_errata();
  for (Erratum& erratum : reflection_errata()) all.push_back(std::move(erratum));
  return all;
}

Erratum erratum_of(const std::string& id) {
  for (const Erratum& erratum : all_errata())
    if (erratum.id == id) return erratum;
  ADD_FAILURE() << "no erratum " << id;
  return {};
}

// Each corrected formula is true, and each printed one is not.
TEST(Errata, NumbersShowEachOfThem) {
  std::set<std::string> ids;
  for (const Erratum& erratum : all_errata()) {
    EXPECT_TRUE(erratum.shown()) << erratum.id << ": printed " << erratum.printed_value.value_or(NAN) << ", corrected "
                                 << erratum.corrected_value << ", true " << erratum.true_value;
    EXPECT_TRUE(ids.insert(erratum.id).second) << erratum.id << " twice";
  }
  EXPECT_EQ(ids.size(), 24u);
}

// By hand: A_4 = 2π √(9/4π) ∫_0^1 P_4(z) z dz with P_4 = (35 z⁴ − 30 z² + 3)/8, whose integral against z is
// (35/6 − 30/4 + 3/2)/8 = −1/48. The print has (n+2)(n+1) = 30 for (n+2)(n−1) = 18.
TEST(Errata, DenominatorByHand) {
  const double by_hand = -2 * std::numbers::pi * std::sqrt(9 / (4 * std::numbers::pi)) / 48;
  const Erratum erratum = erratum_of("denominator");
  EXPECT_NEAR(erratum.true_value, by_hand, 1e-14);
  EXPECT_NEAR(erratum.corrected_value, by_hand, 1e-14);
  EXPECT_NEAR(erratum.printed_value.value_or(0), by_hand * 18 / 30, 1e-14);
}

// A corrected formula that does not hold, or a printed one that does, is not shown.
TEST(Errata, ShownNeedsBothNumbers) {
  Erratum erratum = erratum_of("legendre-norm");
  ASSERT_TRUE(erratum.shown());
  std::swap(*erratum.printed_value, erratum.corrected_value);
  EXPECT_FALSE(erratum.shown());
  erratum.corrected_value = erratum.true_value, erratum.printed_value = erratum.true_value;
  EXPECT_FALSE(erratum.shown());
}

}  // namespace
}  // namespace shlight

// SPDX-License-Identifier: MIT
#include <algorithm>
#include <cmath>
#include <limits>
#include <splinertia/allan/detail/chi_square.hpp>
#include <stdexcept>

#include "allan/detail/chi_square_tails.hpp"
#include "support/catch.hpp"

using namespace splinertia::allan;
using namespace splinertia::allan::detail;

namespace {

using namespace splinertia::detail;

struct Reference {
  double degrees_of_freedom;
  double probability;
  bool upper_tail;
  long double quantile;
};

// Python 3 with mpmath 1.3, mp.dps = 60, the doubles nearest to the numbers as written: Newton's iteration on the
// logarithm of the tail until steps are below 1e-40. Tails for a = degrees/2 < 5000:
//   mp.gammainc(a, 0, x, regularized=True), mp.gammainc(a, x, mp.inf, regularized=True);
// above, mp.quad of exp((a − 1) log t − t − loggamma(a)) by pieces of √a.
constexpr Reference references[] = {
    {0.1, 1e-12, false, 1.1689264114573353272576742836385267e-240L},
    {0.1, 1e-12, true, 43.3953185007931082780648502171152596L},
    {0.1, 0.01, false, 1.16892641145730640190572546192728103e-40L},
    {0.1, 0.01, true, 2.17525480018362024771200418536812442L},
    {0.1, 0.1586552539314571, false, 1.19364818393904689504404829578815812e-16L},
    {0.1, 0.1586552539314571, true, 0.0375842414252907832130899704635087118L},
    {0.1, 0.5, false, 0.00000111477568814924950443547100958865L},
    {0.7, 1e-12, false, 7.45280977050552554527084680920199744e-35L},
    {0.7, 1e-12, true, 49.1795682382585010442305070520799797L},
    {0.7, 0.01, false, 0.00000277810754839638661451814496436420L},
    {0.7, 0.01, true, 5.65316821860897071953175667028857515L},
    {0.7, 0.1586552539314571, false, 0.0074958949297200097271754224504660615L},
    {0.7, 0.1586552539314571, true, 1.39758430806024267758616849817113063L},
    {0.7, 0.5, false, 0.214738971723686504743043896340969031L},
    {2, 1e-12, false, 2.0000000000009999597732959251376707e-12L},
    {2, 1e-12, true, 55.2620422318570964566584996539135107L},
    {2, 0.01, false, 0.0201006717070028827876367395963213745L},
    {2, 0.01, true, 9.210340371976182694438602395294087L},
    {2, 0.1586552539314571, false, 0.34550755804689989925172239171251402L},
    {2, 0.1586552539314571, true, 3.68204329001852637413064292643481738L},
    {2, 0.5, false, 1.38629436111989061883446424291635314L},
    {5.3, 1e-12, false, 0.00009937408675238121677218362610277574L},
    {5.3, 1e-12, true, 66.1144087403320181842397316558553393L},
    {5.3, 0.01, false, 0.643853476056649911242406269105538834L},
    {5.3, 0.01, true, 15.6115711147162180550740893092198893L},
    {5.3, 0.1586552539314571, false, 2.25604846986760933345906214567825411L},
    {5.3, 0.1586552539314571, true, 8.35563460409282278777529674407847061L},
    {5.3, 0.5, false, 4.65031227668034871367430936185237872L},
    {29, 1e-12, false, 1.97648872026837841399704857953335409L},
    {29, 1e-12, true, 118.17696657682545052896765870712826L},
    {29, 0.01, false, 14.2564545762746815597347611749118341L},
    {29, 0.01, true, 49.5878844728988305436105633317401294L},
    {29, 0.1586552539314571, false, 21.4729465849625666976140826292001137L},
    {29, 0.1586552539314571, true, 36.5291246013486709003973969856789366L},
    {29, 0.5, false, 28.3361268665844498936237168785854893L},
    {59.9, 1e-12, false, 11.5065392224570081953939453221702634L},
    {59.9, 1e-12, true, 171.696444194589698830499001756169512L},
    {59.9, 0.01, false, 37.4061105612217272357399659419556512L},
    {59.9, 0.01, true, 88.2581290769860357722802948622533265L},
    {59.9, 0.1586552539314571, false, 49.0161393442399844336960491287998364L},
    {59.9, 0.1586552539314571, true, 70.7848567003760103829941780728712954L},
    {59.9, 0.5, false, 59.2346685286676325592369808929733449L},
    {60.1, 1e-12, false, 11.5854794257218259940686572002836893L},
    {60.1, 1e-12, true, 172.021542748020145994358168531750008L},
    {60.1, 0.01, false, 37.563610212443364892531894040402259L},
    {60.1, 0.01, true, 88.5006909083361972131970482529079436L},
    {60.1, 0.1586552539314571, false, 49.1977785713740968599548317927263579L},
    {60.1, 0.1586552539314571, true, 71.0032141369602411213836818174492794L},
    {60.1, 0.5, false, 59.4346640318018015904425044562369187L},
    {250, 1e-12, false, 123.382084887505954504231048483989187L},
    {250, 1e-12, true, 440.961035757182229352196909844940338L},
    {250, 0.01, false, 200.938623455286068871031179996564043L},
    {250, 0.01, true, 304.939555733957193359761979855008987L},
    {250, 0.1586552539314571, false, 227.669259320278227801047666039500511L},
    {250, 0.1586552539314571, true, 272.330978112823905738775408565005163L},
    {250, 0.5, false, 249.333650306439030575525892930918165L},
    {3000, 1e-12, false, 2486.99233646189787690831424590593649L},
    {3000, 1e-12, true, 3577.62768224754229793409872853964129L},
    {3000, 0.01, false, 2822.74824779302311263385641755099064L},
    {3000, 0.01, true, 3183.13391672515297531745734131341287L},
    {3000, 0.1586552539314571, false, 2922.54894973210448262384029400625835L},
    {3000, 0.1586552539314571, true, 3077.45107002374996431037273722651139L},
    {3000, 0.5, false, 2999.33335967719245192364226731367341L},
    {1e7, 1e-12, false, 9968573.14717295196948563473836129531L},
    {1e7, 1e-12, true, 10031491.49810305099011926979935367L},
    {1e7, 0.01, false, 9989599.19738335519101992556793554789L},
    {1e7, 0.01, true, 10010406.68514244448728967899249271L},
    {1e7, 0.1586552539314571, false, 9995527.86419407458377747443192185877L},
    {1e7, 0.1586552539314571, true, 10004472.1358059313421481435093681976L},
    {1e7, 0.5, false, 9999999.33333334123456847815011822181L},
    {1e12, 1e-12, false, 999990051769.892583281555667855055915L},
    {1e12, 1e-12, true, 1000009948294.75270030293284414922105L},
    {1e12, 0.01, false, 999996710050.226996870212611560178285L},
    {1e12, 0.01, true, 1000003289955.65552903785875923989996L},
    {1e12, 0.1586552539314571, false, 999998585786.437627376651274754023717L},
    {1e12, 0.1586552539314571, true, 1000001414213.56237262334878394798581L},
    {1e12, 0.5, false, 999999999999.333333333333412345679012L},
};

}  // namespace

TEMPLATE_TEST_CASE("Quantiles and tails are those of 50 digits", "", double, long double) {
  constexpr TestType epsilon = std::numeric_limits<TestType>::epsilon();
  for (const Reference& r : references) {
    INFO(r.degrees_of_freedom << " degrees of freedom, probability " << r.probability
                              << (r.upper_tail ? " above" : ""));
    const auto degrees = static_cast<TestType>(r.degrees_of_freedom), p = static_cast<TestType>(r.probability);
    const auto expected = static_cast<TestType>(r.quantile);
    const TestType x = r.upper_tail ? chi_square_upper_quantile(p, degrees) : chi_square_quantile(p, degrees);
    CHECK(std::abs(x / expected - 1) < 80 * epsilon);
    if (!r.upper_tail && p == TestType(0.5)) {
      CHECK(std::abs(chi_square_upper_quantile(p, degrees) / expected - 1) < 80 * epsilon);
    }
    // The rounding of `expected` to this type changes the tail by ε/2 times its condition, x·density/tail.
    const TestType a = degrees / 2;
    const TestType condition = a * gamma_prefactor(a, expected / 2) / p;
    const TestType tail = r.upper_tail ? chi_square_upper_tail(expected, degrees) : chi_square_cdf(expected, degrees);
    CHECK(std::abs(tail / p - 1) < 50 * epsilon * (1 + condition));
  }
}

TEST_CASE("float is rounded from double") {
  for (const Reference& r : references) {
    const auto degrees = static_cast<float>(r.degrees_of_freedom), p = static_cast<float>(r.probability);
    const double wide = chi_square_quantile<double>(p, degrees);
    CHECK(chi_square_quantile(p, degrees) == static_cast<float>(wide));
    if (wide < 1e30) CHECK(chi_square_cdf(static_cast<float>(wide), degrees) >= 0);
  }
  const auto interval = deviation_interval(1.0F, 10.0F), reference = Interval<float>{0.835497220F, 1.326790088F};
  CHECK(interval.lower == reference.lower);  // by mpmath as above
  CHECK(interval.upper == reference.upper);
}

TEST_CASE("Two degrees of freedom are exponential and one is a squared normal number") {
  for (double x : {1e-9, 0.01, 0.5, 1.0, 3.0, 10.0, 50.0, 200.0, 1000.0}) {
    CHECK_THAT(chi_square_upper_tail(x, 2.0), WithinRel(std::exp(-x / 2), 1e-14));
    CHECK_THAT(chi_square_cdf(x, 2.0), WithinRel(-std::expm1(-x / 2), 1e-14));
    CHECK_THAT(chi_square_upper_tail(x, 1.0), WithinRel(std::erfc(std::sqrt(x / 2)), 1e-14 + 4e-16 * x));
    CHECK_THAT(chi_square_cdf(x, 1.0), WithinRel(std::erf(std::sqrt(x / 2)), 1e-14));
  }
  CHECK(chi_square_cdf(0.0, 3.0) == 0);
  CHECK(chi_square_upper_tail(0.0, 3.0) == 1);
}

TEST_CASE("The methods for the tails agree where they meet") {
  for (double a : {30.0, 31.7, 100.0, 1e4}) {
    for (double mu : {-0.399, -0.3, -0.1, -0.01, 0.01, 0.1, 0.3, 0.399}) {
      INFO("a = " << a << ", x/a − 1 = " << mu);
      const auto expanded = expanded_gamma_tails(a, mu);
      double sum = 1, term = 1;
      for (double n = a + 1; term > 1e-17 * sum; ++n) sum += term *= a * (1 + mu) / n;
      const double lower = gamma_prefactor(a, a * (1 + mu)) * sum;
      if (lower > 1e-290) CHECK_THAT(expanded.lower, WithinRel(lower, 1e-14 * (1 + a * mu * mu)));
      CHECK_THAT(expanded.lower + expanded.upper, WithinRel(1.0, 1e-15));
    }
  }
}

TEST_CASE("Quantiles invert the tails and rise, for any degrees of freedom") {
  for (double log_degrees = -1; log_degrees <= 12; log_degrees += 0.37) {
    const double degrees = std::pow(10.0, log_degrees);
    double before = 0;
    for (double p : {1e-12, 1e-6, 0.001, 0.05, 0.2, 0.49, 0.5, 0.51, 0.8, 0.99, 1 - 1e-12}) {
      INFO(degrees << " degrees of freedom, probability " << p);
      const double x = chi_square_quantile(p, degrees);
      CHECK(x > before);
      before = x;
      const double condition = degrees / 2 * gamma_prefactor(degrees / 2, x / 2) / std::min(p, 1 - p);
      const double tail = p > 0.5 ? 1 - chi_square_upper_tail(x, degrees) : chi_square_cdf(x, degrees);
      CHECK(std::abs(tail - p) / std::min(p, 1 - p) < 1e-14 * (1 + condition) + 2e-16 / std::min(p, 1 - p));
    }
  }
}

TEMPLATE_TEST_CASE("Nothing is NaN, however extreme", "", float, double, long double) {
  using Limits = std::numeric_limits<TestType>;
  const TestType values[] = {Limits::min(),   Limits::epsilon(), TestType(1e-3L),  TestType(0.1L),
                             TestType(1),     TestType(59),      TestType(61),     TestType(1e3L),
                             TestType(1e12L), TestType(1e30L),   Limits::max() / 2};
  const TestType probabilities[] = {Limits::min(), TestType(1e-12L), TestType(0.3L), one_sigma<TestType>,
                                    1 - Limits::epsilon()};
  for (TestType degrees : values) {
    for (TestType p : probabilities) {
      INFO(degrees << " degrees of freedom, probability " << p);
      CHECK(chi_square_quantile(p, degrees) >= 0);
      CHECK(chi_square_upper_quantile(p, degrees) >= 0);
      const auto interval = deviation_interval(TestType(1), degrees, p);
      CHECK(interval.lower >= 0);
      CHECK(interval.upper >= interval.lower * (1 - 8 * Limits::epsilon()));  // the same for tiny confidence
    }
    for (TestType x : values) {
      INFO(degrees << " degrees of freedom, x = " << x);
      const TestType lower = chi_square_cdf(x, degrees), upper = chi_square_upper_tail(x, degrees);
      CHECK((lower >= 0 && lower <= 1 && upper >= 0 && upper <= 1));
      CHECK(std::abs(lower + upper - 1) < 4 * Limits::epsilon());
    }
  }
}

TEMPLATE_TEST_CASE("The interval of a deviation is that of its variance's chi-square distribution", "", float, double,
                   long double) {
  const TestType s = 3, edf = 7, c = two_sigma<TestType>;
  const auto interval = deviation_interval(s, edf, c);
  const TestType epsilon = std::numeric_limits<TestType>::epsilon();
  CHECK(std::abs(chi_square_upper_tail(edf * (s / interval.lower) * (s / interval.lower), edf) / ((1 - c) / 2) - 1) <
        100 * epsilon);
  CHECK(std::abs(chi_square_cdf(edf * (s / interval.upper) * (s / interval.upper), edf) / ((1 - c) / 2) - 1) <
        100 * epsilon);
  CHECK(std::abs(one_sigma<TestType> - std::erf(std::sqrt(TestType(0.5L)))) < epsilon);
  CHECK(std::abs(two_sigma<TestType> - std::erf(std::sqrt(TestType(2)))) < epsilon);
  // With many degrees of freedom one sigma is s ± s/√(2 edf).
  const auto narrow = deviation_interval(TestType(1), TestType(1e6L));
  CHECK(std::abs((narrow.upper - narrow.lower) / 2 * std::sqrt(TestType(2e6L)) - 1) < TestType(1e-5L) + 2000 * epsilon);
}

TEST_CASE("The upper end of an interval is infinite only where it overflows") {
  CHECK(deviation_interval(0.0, 0.1).upper == 0);
  CHECK(deviation_interval(0.0, 1e-300).upper == 0);
  // The quantile, 1e-336, underflows; the bound, about 1e167, does not.
  const double c = 1 - 1.1e-16, tail = (1 - c) / 2, edf = 0.0965;
  const auto wide = deviation_interval(1.0, edf, c);
  const double log_quantile = (std::log(tail) + std::lgamma(edf / 2 + 1)) / (edf / 2);
  CHECK(log_quantile < std::log(5e-324));
  CHECK_THAT(std::log(wide.upper), WithinRel((std::log(edf / 2) - log_quantile) / 2, 1e-14));
  CHECK(std::isinf(deviation_interval(1.0, 0.01, c).upper));
  CHECK(std::isinf(deviation_interval(1e30F, 0.1F, 0.9999F).upper));
  CHECK(deviation_interval(1e-30F, 0.1F, 0.9999F).upper > 0.0F);
}

TEMPLATE_TEST_CASE("What is no probability, degree or deviation is refused", "", float, double, long double) {
  using T = TestType;
  const T nan = std::numeric_limits<T>::quiet_NaN(), infinity = std::numeric_limits<T>::infinity();
  for (T degrees : {T(0), T(-1), nan, infinity}) {
    CHECK_THROWS_AS(chi_square_upper_tail(T(1), degrees), std::invalid_argument);
    CHECK_THROWS_AS(chi_square_quantile(T(0.5), degrees), std::invalid_argument);
    CHECK_THROWS_AS(deviation_interval(T(1), degrees), std::invalid_argument);
  }
  for (T p : {T(0), T(1), T(-1), T(2), nan, infinity}) {
    CHECK_THROWS_AS(chi_square_quantile(p, T(1)), std::invalid_argument);
    CHECK_THROWS_AS(deviation_interval(T(1), T(1), p), std::invalid_argument);
  }
  for (T x : {T(-1), nan, infinity}) {
    CHECK_THROWS_AS(chi_square_upper_tail(x, T(1)), std::invalid_argument);
    CHECK_THROWS_AS(deviation_interval(x, T(1)), std::invalid_argument);
  }
}

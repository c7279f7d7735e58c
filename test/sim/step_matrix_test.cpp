#include "knot_utm/sim/step_matrix.hpp"

#include <gtest/gtest.h>

namespace knot_utm {
namespace {

constexpr int kNodes = 30;

/// A contact of point a on nodes a0.. with its foot on b0.., nearer to the end of its segment.
ContactPoint pressed(int a0, int b0) {
  ContactPoint contact;
  contact.a0 = a0;
  contact.b0 = b0;
  contact.overlap = 1e-6;
  contact.c[3] = -0.1;
  contact.c[5] = -0.3;
  return contact;
}

void expect_blocks_of(const std::vector<ContactPoint>& contacts, StepMatrix<3>& matrix) {
  std::size_t n = 0;
  for (const ContactPoint& contact : contacts) {
    if (!contact.active()) continue;
    for (int k = 0; k < 3; ++k)
      for (int l = 0; l < 3; ++l)
        EXPECT_EQ(matrix.contact_blocks(n)[static_cast<std::size_t>(3 * k + l)],
                  matrix.values().pattern().indices(contact.a0 + k, contact.b0 + l));
    ++n;
  }
}

TEST(StepMatrix, FindsTheBlocksOfContactsThatComeSlideAndGo) {
  StepMatrix<3> matrix(kNodes);
  std::vector<ContactPoint> contacts = {pressed(2, 20), pressed(2, 21), pressed(5, 17), pressed(20, 2)};
  matrix.locate(contacts);
  expect_blocks_of(contacts, matrix);
  contacts[1].overlap = -1e-6;                        // lets go
  contacts[2] = pressed(5, 18);                       // slides on, within the room it was given
  contacts.insert(contacts.begin(), pressed(1, 20));  // and a new one
  matrix.locate(contacts);
  expect_blocks_of(contacts, matrix);
  contacts[0] = pressed(1, 9);  // far from anything the pattern had
  matrix.locate(contacts);
  expect_blocks_of(contacts, matrix);
}

TEST(StepMatrix, ForgetsWhatARejectedStepMadeOfThePattern) {
  StepMatrix<3> matrix(kNodes);
  const std::vector<ContactPoint> accepted = {pressed(2, 20), pressed(5, 17)};
  matrix.locate(accepted);
  matrix.commit();
  const int blocks = matrix.values().pattern().blocks();
  for (const int b0 : {12, 24}) {
    matrix.begin();
    const std::vector<ContactPoint> tried = {pressed(2, 20), pressed(5, b0), pressed(5, b0)};
    matrix.locate(tried);
    expect_blocks_of(tried, matrix);
    EXPECT_EQ(matrix.values().pattern().index(5, 16), -1);
    matrix.locate({pressed(2, 21), pressed(9, 26)});  // and once more in the same step
    expect_blocks_of({pressed(2, 21), pressed(9, 26)}, matrix);
  }
  matrix.begin();
  EXPECT_EQ(matrix.values().pattern().blocks(), blocks);
  EXPECT_EQ(matrix.values().pattern().index(5, 12), -1);
  EXPECT_EQ(matrix.values().pattern().index(9, 26), -1);
  matrix.locate(accepted);
  expect_blocks_of(accepted, matrix);
}

TEST(StepMatrix, HasRoomForContactsAboutToComeAndNotForThoseFarAway) {
  StepMatrix<3> matrix(kNodes);
  // Room is looked for where a contact has none.
  ContactPoint near = pressed(2, 20), far = pressed(5, 14), touches = pressed(7, 17);
  for (ContactPoint* contact : {&near, &far}) contact->begins = -1e-4;
  near.overlap = -1.9e-4;
  far.overlap = -2.1e-4;
  matrix.locate({near, far, touches});
  EXPECT_GE(matrix.values().pattern().index(near.a0, near.b0), 0);
  EXPECT_EQ(matrix.values().pattern().index(far.a0, far.b0), -1);
  near.overlap = far.overlap = 0.0;
  matrix.locate({near, far, touches});
  expect_blocks_of({near, far, touches}, matrix);
}

}  // namespace
}  // namespace knot_utm

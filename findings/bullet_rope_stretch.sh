#!/bin/bash
# How far a rope of Bullet 3.24 (btSoftBodyHelpers::CreateRope) stretches under a load that hangs on its end.
#
# A rope of 1 m and 1 kg, one end held, 10 N along it on the other, no gravity, its linear stiffness kLST at 1, the largest there is.
#
# Guessed: kLST = 1 does not stretch, or by an amount that the load sets; more nodes make it more exact.
# Seen: the stretch at rest is in proportion to the load, to the square of the step of time, to about the square of the number of segments, and
# inverse to the iterations. At Bullet's usual 1/60 s and 20 segments: 69 % with the one iteration that is its default, 8 % with ten; 0.59 % with
# ten at 1/240 s; 0.13, 0.59 and 2.5 % with 10, 20 and 40 segments. No kLST is a stiffness in N: one half of it triples the stretch.
# Why it matters: a load-extension curve of a rope or knot from such an engine measures its step of time and mesh, and a finer mesh makes it
# worse. A stiffness has to be fitted anew for each mesh, step and number of iterations.
#
# usage: findings/bullet_rope_stretch.sh
# It loads Debian packages into a temporary folder, needs g++, installs nothing, and ends with 1 where Bullet does otherwise.
set -euo pipefail
folder=$(mktemp -d)
trap 'rm -rf "$folder"' EXIT
cd "$folder"
apt-get -qq download libbullet-dev=3.24+dfsg-2 libbullet3.24=3.24+dfsg-2 2>/dev/null
for package in *.deb; do dpkg -x "$package" tree; done
cat > rope.cpp <<'CPP'
#include <BulletSoftBody/btSoftBodyHelpers.h>
#include <BulletSoftBody/btSoftBodyRigidBodyCollisionConfiguration.h>
#include <BulletSoftBody/btSoftRigidDynamicsWorld.h>
#include <btBulletDynamicsCommon.h>
#include <cmath>
#include <cstdio>

struct Case {
  double load, stiffness;
  int segments, iterations;
  double steps_a_second, percent;
};

double percent(const Case& now) {
  btSoftBodyRigidBodyCollisionConfiguration configuration;
  btCollisionDispatcher dispatcher(&configuration);
  btDbvtBroadphase broadphase;
  btSequentialImpulseConstraintSolver solver;
  btSoftRigidDynamicsWorld world(&dispatcher, &broadphase, &solver, &configuration);
  world.setGravity({0, 0, 0});
  world.getWorldInfo().m_gravity.setZero();
  // The helper takes the number of nodes between both ends; 1 holds the first.
  btSoftBody* rope = btSoftBodyHelpers::CreateRope(world.getWorldInfo(), {0, 0, 0}, {1, 0, 0}, now.segments - 1, 1);
  if (now.iterations > 0) rope->m_cfg.piterations = now.iterations;
  rope->m_materials[0]->m_kLST = now.stiffness;
  rope->m_cfg.kDP = 0.05;
  rope->setTotalMass(1);
  world.addSoftBody(rope);
  for (int step = 0; step < 10 * now.steps_a_second; ++step) {
    rope->addForce({btScalar(now.load), 0, 0}, now.segments);
    world.stepSimulation(1 / now.steps_a_second, 0);
  }
  return 100 * (rope->m_nodes[now.segments].m_x.x() - 1);
}

int main() {
  const Case cases[] = {{10, 1, 20, 0, 60, 69.0},  {10, 1, 20, 10, 60, 8.04},   {10, 1, 20, 10, 240, 0.593}, {10, 1, 20, 50, 240, 0.098},
                        {20, 1, 20, 10, 240, 1.17}, {10, 0.5, 20, 10, 240, 1.886}, {10, 1, 10, 10, 240, 0.127}, {10, 1, 40, 10, 240, 2.458}};
  bool as_seen = true;
  for (const Case& now : cases) {
    const double seen = percent(now);
    const bool same = std::fabs(seen - now.percent) < 0.03 * now.percent;
    std::printf("%g N, kLST %g, %d segments, %d iterations (0: as made), %g steps a second: %.3f %%", now.load, now.stiffness, now.segments,
                now.iterations, now.steps_a_second, seen);
    same ? std::puts("") : std::printf("   expected %g\n", now.percent);
    as_seen &= same;
  }
  return as_seen ? 0 : 1;
}
CPP
lib=tree/usr/lib/x86_64-linux-gnu
g++ -O1 -w -Itree/usr/include/bullet rope.cpp -o rope -L$lib -lBulletSoftBody -lBulletDynamics -lBulletCollision -lLinearMath
LD_LIBRARY_PATH=$lib ./rope

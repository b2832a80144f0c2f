    for i, (stiffness, damping) in SHEAR.items():
        ends = [node(owner) if arm == (0.0, 0.0) else END + 2 * i + k for k, (owner, arm) in enumerate(zip(BEAMS[i][:2], BEAMS[i][2:4]))]
        ops.uniaxialMaterial("Elastic", 90000 + i, stiffness, damping)
        ops.element("twoNodeLink", 90000 + i, *ends, "-mat", 90000 + i, "-dir", 3)

% Housner's equation by Octave's ode45 with Events, as the paper solved it: one call from impact to impact, the record
% interpolated, whatever the solver makes of its kinks.
% argv: a file of numbers (p2, alpha, e, g, dt, rounds, number of rtols, rtols, accel), a file for the answer.
% answer: for each rtol its seconds, then theta at every sample.
1;
function [value, isterminal, direction] = impact(t, y, side)
  value = y(1); isterminal = 1; direction = -side;
end
function theta = history(p2, alpha, e, g, dt, accel, rtol)
  n = numel(accel); theta = zeros(n, 1);
  limit = g * tan(alpha);
  lifted = find(abs(accel) > limit, 1);
  if isempty(lifted), return; end
  side = -sign(accel(lifted));
  share = (-side * limit - accel(lifted - 1)) / (accel(lifted) - accel(lifted - 1));
  t = (lifted - 2 + share) * dt; last = (n - 1) * dt; y = [0; 0];
  a = accel / g;
  ts = []; ys = [];
  while t < last - 1e-9
    ground = @(t) a(min(floor(t / dt) + 1, n)) + (t / dt - floor(t / dt)) * (a(min(floor(t / dt) + 2, n)) - a(min(floor(t / dt) + 1, n)));
    rhs = @(t, y) [y(2); -p2 * (sin(alpha * side - y(1)) + ground(t) * cos(alpha * side - y(1)))];
    options = odeset("RelTol", rtol, "AbsTol", rtol * alpha * 1e-2, "MaxStep", 0.05, "Events", @(t, y) impact(t, y, side));
    [tt, yy, te, ye] = ode45(rhs, [t, last], y, options);
    ts = [ts; tt(1:end-1)]; ys = [ys; yy(1:end-1, 1)];
    if isempty(te), ts = [ts; tt(end)]; ys = [ys; yy(end, 1)]; break; end
    t = te(end); rate = ye(end, 2);
    if abs(rate) < 1e-12, break; end
    side = sign(rate);
    % a hair off the ground, or the event would be found again at once
    y = [side * 1e-12; e * rate];
  end
  [ts, order] = unique(ts);
  theta = interp1(ts, ys(order), (0:n-1)' * dt, "pchip", 0);
end
files = argv();
x = load(files{end-1}); x = x(:);
k = x(7); rtols = x(8:7+k); accel = x(8+k:end);
answer = [];
for rtol = rtols'
  least = Inf;
  for round = 1:x(6)
    tic; theta = history(x(1), x(2), x(3), x(4), x(5), accel, rtol); least = min(least, toc);
  end
  answer = [answer; least; theta];
end
dlmwrite(files{end}, answer, "precision", "%.17g");

function raytube_plot(result, channel)
%RAYTUBE_PLOT  Draws sigma of a result into the current axes.
%
%   raytube_plot(result) draws the four channels of what raytube_read has given, or of the file of that name, against what is
%   swept: the frequency, or else an angle.
%   raytube_plot(result, 'hh') draws one channel: vv, vh, hv or hh. Looks at several frequencies are a map of it (vv by default).
%
%   See also RAYTUBE_READ.
  if ischar(result) || isa(result, 'string')
    result = raytube_read(result);
  end
  names = {'vv', 'vh', 'hv', 'hh'};
  if nargin < 2
    chosen = 1:4;
  else
    chosen = find(strcmpi(names, channel));
  end
  if isempty(chosen)
    error('raytube:plot', '%s: is no channel; name vv, vh, hv or hh', channel);
  end
  frequency_ghz = result.frequency_hz / 1e9;
  [angle, angle_label] = swept_angle(result);
  if numel(angle) > 1 && numel(frequency_ghz) > 1
    draw_map(angle, angle_label, frequency_ghz, level(result, chosen(1)), names{chosen(1)});
  elseif numel(frequency_ghz) > 1
    draw_lines(frequency_ghz, 'frequency, GHz', result, chosen, names);
  else
    draw_lines(angle, angle_label, result, chosen, names);
  end
  if isfield(result, 'attributes') && isfield(result.attributes, 'title')
    title(result.attributes.title, 'Interpreter', 'none');
  end
end

% The angle or the time whose value tells every look from the others, or else the number of the look.
function [angle, label] = swept_angle(result)
  fields = {'phi_deg', 'theta_deg', 'rx_phi_deg', 'rx_theta_deg'};
  labels = {'\phi, degrees', '\theta, degrees', '\phi of the receiver, degrees', '\theta of the receiver, degrees'};
  if isfield(result, 'time_s')
    fields{end + 1} = 'time_s';
    labels{end + 1} = 'time, s';
  end
  looks = numel(result.phi_deg);
  counts = cellfun(@(field) numel(unique(result.(field))), fields);
  which = find(counts == looks, 1);
  if looks > 1 && ~isempty(which)
    angle = result.(fields{which});
    label = labels{which};
  else
    angle = (1:looks)';
    label = 'look';
  end
end

% Of a channel, looks x frequencies.
function sigma = level(result, channel)
  receive = ceil(channel / 2);
  transmit = 2 - mod(channel, 2);
  sigma = result.sigma_dbsm(:, :, receive, transmit);
end

function draw_lines(x, x_label, result, chosen, names)
  floor_dbsm = max(result.sigma_dbsm(:)) - 80;
  curves = zeros(numel(x), numel(chosen));
  for i = 1:numel(chosen)
    curves(:, i) = reshape(level(result, chosen(i)), [], 1);
  end
  [x, order] = sort(x);
  plot(x, curves(order, :));
  if numel(x) > 1
    xlim([x(1), x(end)]);
  end
  grid('on');
  xlabel(x_label);
  ylabel('\sigma, dBsm');
  legend(upper(names(chosen)));
  visible = curves(curves >= floor_dbsm);
  if numel(unique(visible)) > 1
    ylim([min(visible) - 3, max(visible) + 3]);
  end
end

function draw_map(angle, angle_label, frequency_ghz, sigma, name)
  [angle, order] = sort(angle);
  pcolor(angle, frequency_ghz, sigma(order, :).');
  shading('interp');
  peak = max(sigma(:));
  if isfinite(peak)
    caxis([peak - 50, peak]);
  end
  bar = colorbar();
  ylabel(bar, ['\sigma_{', upper(name), '}, dBsm']);
  xlabel(angle_label);
  ylabel('frequency, GHz');
end
